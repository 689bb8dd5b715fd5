#include "pipeline/scene/scene_parts.h"
#include "tests/measure/eval/traced_motion.h"
#include "tests/measure/eval/warp_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace mfar::eval {
namespace {

constexpr double kFocal = 80;
constexpr float kDepth = 2;  // [m]
constexpr double kStep = 0.1;

RigidTransform shifted(double x) {
    return {Eigen::Quaterniond::Identity(), {x, 0, 0}};
}

/// A plane parallel to the picture. Its left half is object 1, its right half object 2.
RenderedPicture twoObjects(const RigidTransform& T_world_camera) {
    RenderedPicture out;
    const Size size{64, 48};
    out.camera = {size, kFocal, kFocal, 31.5, 23.5, {}};
    out.T_world_camera = T_world_camera;
    for (int i = 0; i < size.width * size.height; ++i) {
        out.depth.push_back(kDepth);
        out.id.push_back(i % size.width < size.width / 2 ? 1 : 2);
    }
    return out;
}

cv::Vec2f motionAt(const PosedPicture& before, const PosedPicture& now, int x) {
    return motionTo(before, now).at<cv::Vec2f>(20, x);
}

TEST(TracedMotion, FollowsTheObjectsAndTheCamera) {
    constexpr double kShift = kFocal * kStep / kDepth;  // [px]
    const RenderedPicture picture = twoObjects({});
    // Object 1 has moved to the right, so its points were farther to the left before.
    cv::Vec2f u = motionAt({picture, {{}, {}}}, {picture, {shifted(kStep), {}}}, 16);
    EXPECT_NEAR(u[0], -kShift, 1e-3);
    EXPECT_NEAR(u[1], 0, 1e-3);
    u = motionAt({picture, {{}, {}}}, {picture, {shifted(kStep), {}}}, 48);
    EXPECT_NEAR(u[0], 0, 1e-3) << "object 2 does not move";
    const RenderedPicture moved = twoObjects(shifted(kStep));
    u = motionAt({picture, {{}, {}}}, {moved, {shifted(kStep), {}}}, 16);
    EXPECT_NEAR(u[0], 0, 1e-3) << "the camera moves with object 1";
    u = motionAt({picture, {{}, {}}}, {moved, {shifted(kStep), {}}}, 48);
    EXPECT_NEAR(u[0], kShift, 1e-3);
}

TEST(TracedMotion, IsUnknownWhereAnotherObjectWas) {
    const RenderedPicture picture = twoObjects({});
    // The first columns of object 2 come from where object 1 is before.
    const PosedPicture before{picture, {{}, {}}}, now{picture, {{}, shifted(kStep)}};
    EXPECT_TRUE(std::isnan(motionAt(before, now, 33)[0]));
    EXPECT_FALSE(std::isnan(motionAt(before, now, 40)[0]));
}

/// The still life. Its first object moves by `step` in 1 s.
std::shared_ptr<const Scene> moving(const Eigen::Vector3d& step) {
    Scene scene = *warpScene("still-life");
    RigidPath path;
    path.length = 2;
    path.joints.resize(1);
    RigidPath::Joint& joint = path.joints.front();
    const Eigen::Vector3d at = scene.objects.front().T_world_object.translation;
    joint.rest = scene.objects.front().T_world_object;
    const auto keyOf = [](const Eigen::Vector3d& p) {
        return Eigen::Vector4d(p.x(), p.y(), p.z(), 0);
    };
    joint.translation = {MotionTrack::Between::Linear, {0, 1}, {keyOf(at), keyOf(at + step)}};
    scene.objects.front().path = std::make_shared<const RigidPath>(path);
    return std::make_shared<const Scene>(scene);
}

TEST(TracedMotion, LeadsToTheSamePointOfAMovingTracedObject) {
    // A step towards the right of the picture.
    const auto scene = moving({0.05, 0, 0});
    const RenderView view = warpView(*scene, {96, 72}, 0);
    const auto tracedAt = [&](double seconds) {
        const auto posed =
            std::make_shared<const Scene>(sceneAt(*scene, Timestamp::fromSeconds(seconds)));
        return tracePicture(PathTracer(posed, tracerOptions(true)), view, 1);
    };
    const RenderedPicture before = tracedAt(0), now = tracedAt(1);
    const cv::Mat motion =
        motionTo({before, posesAt(*scene, {})}, {now, posesAt(*scene, Timestamp::fromSeconds(1))});
    int compared = 0, same = 0;
    for (int y = 0; y < motion.rows; ++y)
        for (int x = 0; x < motion.cols; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * motion.cols + x;
            const auto& u = motion.at<cv::Vec2f>(y, x);
            if (now.id[i] != 1 || !std::isfinite(u[0])) continue;
            ++compared;
            EXPECT_LT(u[0], -0.5) << "the object has moved to the right";
            const auto column = std::lround(x + u[0]), row = std::lround(y + u[1]);
            const auto seen = static_cast<std::size_t>(row * motion.cols + column);
            same += std::abs(before.depth[seen] - now.depth[i]) < 0.01F ? 1 : 0;
        }
    EXPECT_GT(compared, 20);
    EXPECT_GE(same, compared * 9 / 10);
}

}  // namespace
}  // namespace mfar::eval
