#include "tests/engine/gl_test.h"
#include "tests/engine/gles/pipeline_case.h"

#include <cmath>

namespace mfar {
namespace {

using PipelinePose = GlTest;
using Eigen::Vector3d;

Pose poseAt(const Vector3d& translation, const Vector3d& degrees = Vector3d::Zero()) {
    constexpr double kDegree = 0.017453292519943295;
    Pose pose;
    const double angle = kDegree * degrees.norm();
    if (angle > 0) pose.T_world_video.rotation = Eigen::AngleAxisd(angle, degrees.normalized());
    pose.T_world_video.translation = translation;
    return pose;
}

/// Poses after a sideways motion, a forward motion with the epipole in the picture, a pure
/// rotation, no motion, a tiny motion, and a very long one.
std::vector<Pose> poses() {
    return {
        poseAt({0.1, 0.02, 0}),   poseAt({0.01, 0, 0.3}), poseAt(Vector3d::Zero(), {0, 2, 1}),
        poseAt(Vector3d::Zero()), poseAt({1e-9, 0, 0}),   poseAt({1e6, 1e6, -1e6}, {10, 170, 30})};
}

void expectSound(const Pipeline& p, const std::string& what) {
    for (const float v : p.readFlow())
        ASSERT_TRUE(std::isfinite(v)) << what;
    for (const float v : p.readConfidence())
        ASSERT_TRUE(v >= 0 && v <= 1) << what << ": " << v;
    const FrameStats s = p.readStats();
    EXPECT_TRUE(s.usedPose) << what;
    for (const double v : {s.meanConfidence, s.explained, s.changed, s.redrawn})
        EXPECT_TRUE(v >= 0 && v <= 1) << what << ": " << v;
    EXPECT_TRUE(std::isfinite(s.epipolarError)) << what;
    EXPECT_EQ(static_cast<int>(p.readSearchedTiles().size()), 10 * 8) << what;
}

TEST_F(PipelinePose, ExtremePicturesAndPosesGiveNoNan) {
    const PipelineCase c;
    const Size video = c.rig.video.size, fine = c.rig.still.size;
    const std::vector<TestPicture> frames{TestPicture(video, PixelFormat::Rgba8, 0),
                                          TestPicture(video, PixelFormat::Rgba8, 255),
                                          checkerboard(video), randomPicture(video, 1), c.video()};
    const std::vector<TestPicture> stills{TestPicture(fine, PixelFormat::Rgba8, 255),
                                          checkerboard(fine), randomPicture(fine, 2), c.still()};
    Pipeline p(c.rig, {});
    for (std::size_t s = 0; s < stills.size(); ++s) {
        p.setStill(stills[s].view(), {}, poseAt(Vector3d::Zero()));
        for (std::size_t f = 0; f < frames.size(); ++f)
            for (std::size_t i = 0; i < poses().size(); ++i) {
                p.run(frames[f].view(), {}, poses()[i]);
                expectSound(p, "still " + std::to_string(s) + ", frame " + std::to_string(f) +
                                   ", pose " + std::to_string(i));
            }
    }
}

TEST_F(PipelinePose, ResultsDoNotDependOnTheUnitOfLength) {
    const PipelineCase c;
    const auto run = [&](double unit) {
        StereoRig rig = c.rig;
        rig.T_still_video.translation = unit * Vector3d(0.014, 0, 0);
        Pipeline p(rig, {});
        p.setStill(c.still().view(), {}, poseAt(Vector3d::Zero()));
        p.run(c.video({3, 1}).view(), {}, poseAt(unit * Vector3d(0.03, 0.01, 0.002)));
        return std::pair(p.readImage(), p.readFlow());
    };
    const auto metres = run(1), millimetres = run(1000);
    EXPECT_EQ(metres.first, millimetres.first);
    ASSERT_EQ(metres.second.size(), millimetres.second.size());
    for (std::size_t i = 0; i < metres.second.size(); ++i)
        ASSERT_NEAR(metres.second[i], millimetres.second[i], 1e-3) << i;
}

TEST_F(PipelinePose, SearchStartsFromThePreviousFrame) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setStill(c.still().view(), {}, poseAt(Vector3d::Zero()));
    const auto predicted = [&](int frame) {
        p.run(c.video({2.0 + frame, 0}).view(), {}, poseAt({0.02 + 0.01 * frame, 0, 0}));
        return p.readStats().predicted;
    };
    EXPECT_FALSE(predicted(0));
    for (int frame = 1; frame <= 7; ++frame)
        EXPECT_TRUE(predicted(frame)) << frame;
    EXPECT_FALSE(predicted(8)) << "every 8th frame must be searched without a prediction";
    EXPECT_TRUE(predicted(9));
    p.setStill(c.still().view(), {}, poseAt(Vector3d::Zero()));
    EXPECT_FALSE(predicted(10));
}

TEST_F(PipelinePose, AnIdenticalFrameIsNotSearched) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setStill(c.still().view(), {}, poseAt(Vector3d::Zero()));
    p.run(c.video({2, 0}).view(), {}, poseAt({0.02, 0, 0}));
    const auto image = p.readImage();
    const auto flow = p.readFlow();
    // The pose changes but the picture does not. Nothing may be searched, because no tile changed.
    p.run(c.video({2, 0}).view(), {}, poseAt({0.3, 0.2, 0}, {0, 5, 0}));
    EXPECT_EQ(p.readStats().redrawn, 0);
    EXPECT_EQ(p.readStats().searched2d, 0);
    EXPECT_EQ(p.readImage(), image);
    EXPECT_EQ(p.readFlow(), flow);
}

}  // namespace
}  // namespace mfar
