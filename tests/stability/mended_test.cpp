// Regression tests: one for each input on which a hostile case failed before the code was fixed.
#include "pipeline/depth/depth_filter.h"
#include "pipeline/depth/edge_snap.h"
#include "pipeline/epipolar/epipolar_flow.h"
#include "pipeline/track/pose_filter.h"
#include "tests/engine/pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace mfar::stress {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

std::shared_ptr<Workers> oneWorker() {
    return std::make_shared<Workers>(1);
}

CameraModel smallCamera(Size size = {8, 6}) {
    return {size, 10, 10, 0.5 * (size.width - 1), 0.5 * (size.height - 1), {}};
}

InverseDepthField fieldOf(Size size, float inverseDepth, float variance) {
    InverseDepthField out(size);
    out.inverseDepth.assign(out.inverseDepth.size(), inverseDepth);
    out.variance.assign(out.variance.size(), variance);
    return out;
}

TEST(Mended, InvalidMeasurementsAreIgnored) {
    const PixelRect whole{0, 0, 8, 6};
    for (const auto& [inverseDepth, variance] : {std::pair(kNan, 0.01F),
                                                 {kInf, 0.01F},
                                                 {-1.0F, 0.01F},
                                                 {0.5F, kNan},
                                                 {0.5F, -0.01F},
                                                 {0.5F, 0.0F}}) {
        DepthFilter filter(smallCamera(), oneWorker());
        filter.predict({}, 0.03);
        filter.fuse(fieldOf({8, 6}, 0.5F, 0.01F), whole);
        filter.fuse(fieldOf({8, 6}, inverseDepth, variance), whole);
        filter.fuse(fieldOf({8, 6}, inverseDepth, variance), whole);
        EXPECT_EQ(filter.field().inverseDepth[20], 0.5F) << inverseDepth << ", " << variance;
        EXPECT_EQ(filter.field().variance[20], 0.01F);
    }
}

TEST(Mended, DepthIsDiscardedAfterAnInvalidPose) {
    for (const double bad : {double(kNan), double(kInf), 0.0}) {
        DepthFilter filter(smallCamera(), oneWorker());
        filter.predict({}, 0.03);
        filter.fuse(fieldOf({8, 6}, 0.5F, 0.01F), {0, 0, 8, 6});
        RigidTransform none;
        none.rotation.coeffs().setConstant(bad);
        filter.predict(none, 0.03);
        EXPECT_FALSE(filter.field().isKnown(20)) << bad;
        filter.predict({}, 0.03);
        filter.fuse(fieldOf({8, 6}, 0.25F, 0.01F), {0, 0, 8, 6});
        EXPECT_EQ(filter.field().inverseDepth[20], 0.25F);
    }
}

TEST(Mended, AnInvalidTimeDoesNotIncreaseTheVariance) {
    DepthFilter filter(smallCamera(), oneWorker());
    filter.predict({}, 0.03);
    filter.fuse(fieldOf({8, 6}, 0.5F, 0.01F), {0, 0, 8, 6});
    RigidTransform aside;
    aside.translation.x() = 0.4;
    filter.predict(aside, kNan);
    int known = 0;
    for (std::size_t i = 0; i < filter.field().inverseDepth.size(); ++i)
        if (filter.field().isKnown(i)) {
            ++known;
            EXPECT_EQ(filter.field().variance[i], 0.01F);
        }
    EXPECT_GT(known, 0);
}

TEST(Mended, EdgeSnapKeepsInvalidDepthUnknown) {
    EdgeSnap snap({8, 6}, oneWorker());
    const TestPicture picture({8, 6});
    for (const auto& [inverseDepth, variance] :
         {std::pair(kNan, 0.01F), {kInf, 0.01F}, {0.5F, -1.0F}}) {
        const auto& out =
            snap.run(fieldOf({8, 6}, inverseDepth, variance), picture.view(), {0, 0, 8, 6});
        EXPECT_FALSE(out.isKnown(20)) << inverseDepth << ", " << variance;
        EXPECT_EQ(out.inverseDepth[20], 0);
    }
}

// The picture's only ray is the optical axis. So the lens model's valid range has radius zero.
TEST(Mended, EpipolarLensAcceptsAPictureOfOnePixel) {
    const EpipolarLens lens(smallCamera({1, 1}), 0);
    const auto p = lens.project(0, 0);
    EXPECT_EQ(p.x, 0);
    EXPECT_EQ(p.y, 0);
}

TEST(Mended, EpipolarFlowAcceptsPicturesWithOneColumnOrRowOfCells) {
    for (const Size size : {Size{1, 1}, Size{1, 40}, Size{40, 1}, Size{2, 3}}) {
        EpipolarFlow flow({smallCamera(size), smallCamera(size), {}}, oneWorker());
        const TestPicture picture = randomPicture(size, 1);
        Pose aside;
        aside.T_world_video.translation.x() = 0.1;
        flow.setStill(picture.view(), {});
        flow.run(picture.view(), aside);
        for (const auto& v : flow.forward())
            EXPECT_TRUE(std::isfinite(v[0]) && std::isfinite(v[1])) << size.width;
    }
}

// If the camera rests, the baseline is only the distance between the rig's cameras. The error of a
// tracked pose is a quarter of this baseline or more. When such poses were used, no real thing hid
// a virtual object.
TEST(Mended, AtRestEpipolarFlowUsesTheRigAlone) {
    const CameraModel camera = smallCamera({64, 48});
    EpipolarFlow flow({camera, camera, {Eigen::Quaterniond::Identity(), {0.02, 0, 0}}},
                      oneWorker());
    const TestPicture picture = randomPicture({64, 48}, 1);
    Pose still, frame;
    still.covariance = frame.covariance = 1e-5 * Matrix6::Identity();
    frame.T_world_video.translation.x() = 0.004;
    flow.setStill(picture.view(), still);
    for (const bool rests : {false, true}) {
        flow.run(picture.view(), frame, {0, 0, 64, 48}, rests);
        EXPECT_NEAR(flow.unit(), rests ? 0.02 : 0.024, 1e-9);
        EXPECT_EQ(flow.lengthError() < 0.02, rests);
    }
}

TEST(Mended, ANonFinitePredictionActsLikeAnExtremeFiniteOne) {
    const CameraModel camera = smallCamera({64, 48});
    const TestPicture picture = randomPicture({64, 48}, 1);
    const auto searched = [&](float predicted) {
        EpipolarSearch search({camera, camera, {}}, oneWorker());
        search.setStill(picture.view());
        LumaImage luma;
        lumaOf(picture.view(), luma);
        const std::vector<float> cells(16UL * 12, predicted);
        EXPECT_TRUE(search.run(luma, {Eigen::Quaterniond::Identity(), {0.1, 0, 0}}, {}, cells));
        return search.s();
    };
    EXPECT_EQ(searched(kNan), searched(-1e30F));
    EXPECT_EQ(searched(-kInf), searched(-1e30F));
    EXPECT_EQ(searched(kInf), searched(1e30F));
}

TEST(Mended, TheSearchAcceptsAnInvalidCovariance) {
    const CameraModel camera = smallCamera({64, 48});
    const TestPicture picture = randomPicture({64, 48}, 1);
    LumaImage luma;
    lumaOf(picture.view(), luma);
    for (const double bad : {double(kNan), double(kInf), -1.0}) {
        EpipolarSearch search({camera, camera, {}}, oneWorker());
        search.setStill(picture.view());
        const Matrix6 covariance = Matrix6::Identity() * bad;
        EXPECT_TRUE(search.run(luma, {Eigen::Quaterniond::Identity(), {0.1, 0, 0}}, covariance));
        EXPECT_TRUE(search.normalError() >= 0 && search.normalError() <= 1e6) << bad;
    }
}

TEST(Mended, PosesWithAnInvalidCovarianceOrRotationAreRejected) {
    PoseFilter filter;
    Pose pose{Timestamp::fromSeconds(1), {}};
    pose.covariance(2, 2) = -1;
    EXPECT_EQ(filter.update(pose, 1), PoseFilter::Outcome::Rejected);
    EXPECT_FALSE(filter.predict(pose.time));
    pose.covariance.setIdentity();
    pose.T_world_video.rotation.coeffs().setZero();
    EXPECT_EQ(filter.update(pose, 1), PoseFilter::Outcome::Rejected);
    // A quaternion whose norm is slightly off must be accepted and normalised.
    pose.T_world_video.rotation.coeffs() << 0, 0, 0, 1.001;
    EXPECT_EQ(filter.update(pose, 1), PoseFilter::Outcome::Started);
    ASSERT_TRUE(filter.predict(pose.time));
    EXPECT_NEAR(filter.predict(pose.time)->T_world_video.rotation.norm(), 1, 1e-12);
}

}  // namespace
}  // namespace mfar::stress
