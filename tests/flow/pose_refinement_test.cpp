#include "pipeline/epipolar/epipolar_search.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace mfar {
namespace {

using test::motion;
using test::Scene;
using test::View;

CameraModel pagePlain() {
    return {{240, 180}, 230, 230, 119.5, 89.5, {}};
}

CameraModel pageBarrel() {
    return {{240, 180}, 195, 196, 123, 87, {-0.29, 0.08, 0.001, -0.0012, 0.002}};
}

Scene panelScene() {
    return {{{{0.1, 0.1, 1}, 3}, {{0, 0, 1}, 2, {-0.35, -0.4}, {0.45, 0.3}}}, 28, 100};
}

Matrix6 covarianceOf(double degrees, double shift) {
    const double turn = degrees * 3.14159265358979323846 / 180;
    Vector6 diagonal;
    diagonal << Eigen::Vector3d::Constant(turn * turn), Eigen::Vector3d::Constant(shift * shift);
    return diagonal.asDiagonal();
}

double missOf(const RigidTransform& pose, const View& view) {
    const CameraModel& camera = view.camera;
    std::vector<double> out;
    for (int y = 5; y < camera.size.height; y += 10) {
        for (int x = 5; x < camera.size.width; x += 10) {
            const Eigen::Vector3d ray = camera.unproject({x, y}).homogeneous();
            const Eigen::Vector3d p =
                view.T_still_video * (view.scene.depth({}, ray.head<2>()) * ray);
            if (!(p.z() > 0)) continue;
            const Eigen::Vector3d seen = p.hnormalized().homogeneous();
            const Eigen::Vector3d turned = pose.rotation * ray;
            const Eigen::Vector3d line = pose.translation.cross(turned);
            const double off = view.T_still_video.translation.norm() > 0
                                   ? std::abs(seen.dot(line)) / line.head<2>().norm()
                                   : (turned.hnormalized() - seen.head<2>()).norm();
            out.push_back(camera.fx * off);
        }
    }
    std::sort(out.begin(), out.end());
    return out[out.size() / 2];
}

struct Shots {
    View view;
    LumaImage video, still;
    Shots(const View& v) : view(v), video(v.video()), still(v.still()) {}
};

EpipolarSearch searched(const Shots& shots, const RigidTransform& error,
                        const Matrix6& covariance) {
    EpipolarSearch search = test::searchWith(shots.view.camera, 2);
    search.setStill(test::viewOf(shots.still));
    EXPECT_TRUE(search.run(shots.video, shots.view.T_still_video * error, covariance));
    EXPECT_TRUE(test::isFinite(search));
    return search;
}

double depthErrorOf(const EpipolarSearch& search, const View& view) {
    const Size size = view.camera.size;
    int bad = 0, all = 0;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const double z = view.scene.depth({}, view.camera.unproject({x, y}));
            if (!(z > 0)) continue;
            const double s = search.s()[static_cast<std::size_t>(y) * size.width + x];
            ++all;
            if (std::abs(s - 1 / z) * search.pixelsPerUnit() > 1) ++bad;
        }
    }
    return static_cast<double>(bad) / all;
}

const Matrix6 kUsual = covarianceOf(0.4, 0.002);

std::vector<View> views() {
    return {{pagePlain(), panelScene(), motion({0, 0, 0}, {-0.2, 0.02, 0})},
            {pagePlain(), panelScene(), motion({2, -3, 10}, {0.1, 0.15, 0.05})},
            {pageBarrel(), panelScene(), motion({-3, 5, -8}, {0.2, 0.05, -0.1})},
            {pagePlain(), panelScene(), motion({0, 0, 0}, {0.02, 0.01, 0.4})}};
}

// At the focal length of these cameras, a rotation by half a degree moves pixels by about 2 px.
TEST(PoseRefinement, CorrectsEpipolarLinesToAQuarterPixel) {
    for (const View& view : views()) {
        const Shots shots(view);
        for (const Eigen::Vector3d& off :
             {Eigen::Vector3d(0.2, 0, 0), Eigen::Vector3d(0.35, -0.35, 0),
              Eigen::Vector3d(-0.5, 0.1, 0.4)}) {
            const RigidTransform error = motion(off, {0, 0, 0});
            const EpipolarSearch search = searched(shots, error, kUsual);
            const double before = missOf(view.T_still_video * error, view);
            EXPECT_LT(missOf(search.pose(), view), 0.25)
                << off.transpose() << ", error before the refinement: " << before;
            EXPECT_LT(search.refinement().normalAfter, 0.25);
            EXPECT_NEAR(search.refinement().normalBefore, before, 0.2 + 0.25 * before);
            EXPECT_LT(test::errorsOf(search, view).bad, 0.06);
        }
    }
}

TEST(PoseRefinement, KeepsAGoodPose) {
    for (const View& view : views()) {
        const EpipolarSearch search = searched(view, {}, kUsual);
        EXPECT_FALSE(search.refinement().accepted);
        EXPECT_GT(search.refinement().patches, 50);
        EXPECT_LT(search.refinement().normalBefore, 0.25);
        EpipolarSearch exact = test::searchWith(view.camera, 2);
        exact.setStill(test::viewOf(view.still()));
        ASSERT_TRUE(exact.run(view.video(), view.T_still_video));
        EXPECT_EQ(search.s(), exact.s());
    }
}

TEST(PoseRefinement, AnUncertainPoseIsSearchedInALargerRangeThanACertainPose) {
    const View view{pagePlain(), panelScene(), motion({3, -4, 5}, {0, 0, 0})};
    const RigidTransform error = motion({1.5, -1, 0.3}, {0, 0, 0});
    EXPECT_LT(missOf(searched(view, error, covarianceOf(1, 0)).pose(), view), 0.1);
    EXPECT_GT(missOf(searched(view, error, covarianceOf(0.1, 0)).pose(), view), 1);
}

TEST(PoseRefinement, PureRotationIsRefinedWithoutASearch) {
    const View view{pagePlain(), panelScene(), motion({3, -4, 5}, {0, 0, 0})};
    const EpipolarSearch search =
        searched(view, motion({0.3, 0.4, -0.3}, {0, 0, 0}), covarianceOf(0.4, 0));
    EXPECT_TRUE(search.refinement().accepted);
    EXPECT_EQ(search.labels(), 0);
    EXPECT_LT(missOf(search.pose(), view), 0.1);
}

// A panel in front of a wall moves by itself, across the epipolar lines. It contains nearly half of
// the patches.
TEST(PoseRefinement, MovingObjectsDoNotDisturbThePose) {
    View view{pagePlain(), panelScene(), motion({0, 0, 0}, {-0.2, 0, 0})};
    view.scene.surfaces[1].least = {-0.75, -0.75};
    view.scene.surfaces[1].greatest = {0.65, 0.35};
    const LumaImage video = view.video();
    // A surface that is moved in the scene would get another texture, which depends on the
    // position. So the still's panel is rendered from a moved camera instead.
    const RigidTransform lifted = view.T_still_video * motion({0, 0, 0}, {0, 0.06, 0});
    LumaImage still = view.still();
    const Scene moving{{view.scene.surfaces[1]}, 28, 100};
    const LumaImage panel = moving.render(view.camera, lifted);
    for (int y = 0; y < still.size.height; ++y) {
        for (int x = 0; x < still.size.width; ++x) {
            const Eigen::Vector2d ray = view.camera.unproject({x, y});
            if (moving.depth(lifted, ray) > 0) still.row(y)[x] = panel.row(y)[x];
        }
    }
    view.scene.surfaces.resize(1);
    for (const double off : {0.0, 0.3}) {
        EpipolarSearch search = test::searchWith(view.camera, 2);
        search.setStill(test::viewOf(still));
        ASSERT_TRUE(search.run(video, view.T_still_video * motion({-off, 0, off}, {0, 0, 0}),
                               covarianceOf(0.3, 0.002)));
        EXPECT_LT(missOf(search.pose(), view), 0.25) << off;
    }
}

TEST(PoseRefinement, UniformPicturesLeaveThePriorPoseUnchanged) {
    const CameraModel camera = pagePlain();
    const LumaImage scene = panelScene().render(camera, {});
    std::vector<LumaImage> pictures;
    for (const int grey : {0, 128, 255}) {
        pictures.emplace_back(camera.size);
        std::fill(pictures.back().pixels.begin(), pictures.back().pixels.end(), grey);
    }
    const RigidTransform pose = motion({1, 2, 3}, {0.2, 0, 0});
    for (const LumaImage& picture : pictures) {
        for (const auto& [video, still] : {std::pair(picture, scene), {scene, picture}}) {
            EpipolarSearch search = test::searchWith(camera, 2);
            search.setStill(test::viewOf(still));
            ASSERT_TRUE(search.run(video, pose, kUsual));
            EXPECT_FALSE(search.refinement().accepted);
            EXPECT_EQ(search.refinement().patches, 0);
            EXPECT_EQ(search.pose().rotation.coeffs(), pose.rotation.coeffs());
            EXPECT_EQ(search.pose().translation, pose.translation);
        }
    }
}

TEST(PoseRefinement, NonFiniteInputIsNotRefined) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const View view = views()[1];
    EpipolarSearch search = test::searchWith(view.camera, 2);
    search.setStill(test::viewOf(view.still()));
    const LumaImage video = view.video();
    EXPECT_FALSE(search.run(video, motion({0, kNan, 0}, {0.1, 0, 0}), kUsual));
    (void)search.run(video, motion({0, 0, 0}, {0.1, kNan, 0}), kUsual);
    EXPECT_FALSE(search.refinement().accepted);
    EXPECT_TRUE(test::isFinite(search));
    ASSERT_TRUE(
        search.run(video, view.T_still_video * motion({0.5, 0, 0}, {0, 0, 0}), kNan * kUsual));
    EXPECT_FALSE(search.refinement().accepted);
    EXPECT_TRUE(test::isFinite(search));
}

TEST(PoseRefinement, IsInvariantToTheUnitOfLength) {
    const View view = views()[2];
    const RigidTransform error = motion({0.3, 0.1, -0.3}, {0.002, 0, 0.001});
    const EpipolarSearch metres = searched(view, error, kUsual);
    RigidTransform prior = view.T_still_video * error;
    prior.translation *= 1000;
    Vector6 scale = Vector6::Ones();
    scale.tail<3>().setConstant(1000);
    EpipolarSearch search = test::searchWith(view.camera, 2);
    search.setStill(test::viewOf(view.still()));
    ASSERT_TRUE(search.run(view.video(), prior, scale.asDiagonal() * kUsual * scale.asDiagonal()));
    ASSERT_TRUE(search.refinement().accepted);
    EXPECT_NEAR(search.refinement().normalAfter, metres.refinement().normalAfter, 0.01);
    EXPECT_LT(search.pose().rotation.angularDistance(metres.pose().rotation), 1e-4);
    EXPECT_LT((search.pose().translation / 1000 - metres.pose().translation).norm(), 1e-4);
}

TEST(PoseRefinement, TheResultDoesNotDependOnTheNumberOfThreads) {
    const View view = views()[2];
    const RigidTransform prior = view.T_still_video * motion({0.3, 0.1, -0.3}, {0, 0, 0});
    const LumaImage video = view.video(), still = view.still();
    std::vector<float> one;
    for (int threads = 1; threads <= 3; ++threads) {
        EpipolarSearch search = test::searchWith(view.camera, threads);
        search.setStill(test::viewOf(still));
        for (int again = 0; again < 2; ++again) {
            ASSERT_TRUE(search.run(video, prior, kUsual));
            if (one.empty()) one = search.s();
            ASSERT_EQ(search.s(), one) << threads << " threads";
        }
    }
}

TEST(PoseRefinement, WithTooFewPatchesTheSearchAlsoLooksBesideEpipolarLines) {
    const Shots shots({pagePlain(),
                       {{{{0.3, 0, 1}, 2, {-0.1, -0.1}, {0.15, 0.1}}}, 60, 100},
                       motion({0, 0, 0}, {0.2, 0, 0})});
    const RigidTransform error = motion({0.4, 0, 0}, {0, 0, 0});
    const EpipolarSearch roomy = searched(shots, error, covarianceOf(0.4, 0.002));
    EXPECT_FALSE(roomy.refinement().accepted);
    EXPECT_LT(roomy.refinement().patches, 16);
    EXPECT_NEAR(roomy.normalError(), 1.6, 0.1);
    EpipolarSearch strict = test::searchWith(pagePlain(), 2);
    strict.setStill(test::viewOf(shots.still));
    ASSERT_TRUE(strict.run(shots.video, shots.view.T_still_video * error));
    EXPECT_EQ(strict.normalError(), 0);
    const double without = depthErrorOf(strict, shots.view);
    EXPECT_LT(depthErrorOf(roomy, shots.view), 0.5 * without);
    EXPECT_GT(without, 0.1);
}

}  // namespace
}  // namespace mfar
