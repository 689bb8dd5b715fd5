#include "hal/virtual/synthetic_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mfar::synthetic {
namespace {

constexpr std::array kAllScenes{Scene::Office, Scene::Shelf,  Scene::Outdoor,
                                Scene::Flat,   Scene::Moving, Scene::Still};
constexpr double kDegree = std::numbers::pi / 180;

/// A viewpoint with a quarter of the video's width and height, so that a test is 16 times faster.
Viewpoint small(const World& world, Path path, double t) {
    return {boardRig().video.scaledTo({160, 120}), cameraPose(world, path, 1, t), t};
}

Eigen::Vector3d ray(const CameraModel& camera, int x, int y) {
    const Eigen::Vector2d r = camera.unproject({1. * x, 1. * y});
    return {r.x(), r.y(), 1};
}

bool known(const std::array<float, 2>& v) {
    return std::isfinite(v[0]) && std::isfinite(v[1]);
}

TEST(SyntheticRig, SensorsStandFourteenMillimetresApartAndAlmostParallel) {
    const StereoRig rig = boardRig();
    EXPECT_NEAR(rig.T_still_video.translation.norm(), 0.014, 1e-9);
    const double angle = Eigen::AngleAxisd(rig.T_still_video.rotation).angle() / kDegree;
    EXPECT_GT(angle, 0.3);
    EXPECT_LT(angle, 0.7);
}

TEST(SyntheticRig, LensesCanBeInvertedOverTheWholePicture) {
    const StereoRig rig = boardRig();
    for (const CameraModel& camera : {rig.video, rig.still}) {
        for (const double u : {-0.01, 0.25, 0.6, 1.01}) {
            for (const double v : {-0.01, 0.3, 0.7, 1.01}) {
                const Eigen::Vector2d p{u * camera.size.width, v * camera.size.height};
                const Eigen::Vector2d ray = camera.unproject(p);
                EXPECT_LT((camera.project(ray) - p).norm(), 1e-6);
                // unproject() must find the ray even if the initial value of the search is far
                // outside the picture.
                for (const double off : {0.0, 1e-3, 0.2, 2.0})
                    EXPECT_LT((camera.unproject(p, ray - Eigen::Vector2d(off, off)) - ray).norm(),
                              1e-9);
            }
        }
    }
}

TEST(SyntheticPath, HandHeldShakeIsSmallAndSmooth) {
    const World world = makeWorld(Scene::Office, 1);
    const RigidTransform rest = cameraPose(world, Path::Rest, 1, 0);
    RigidTransform last = cameraPose(world, Path::Handheld, 1, 0);
    double widest = 0;
    for (int i = 1; i < 300; ++i) {
        const RigidTransform now = cameraPose(world, Path::Handheld, 1, i / 30.);
        EXPECT_LT((now.translation - rest.translation).norm(), 0.015);
        EXPECT_LT(now.rotation.angularDistance(rest.rotation), 3 * kDegree);
        EXPECT_LT(now.rotation.angularDistance(last.rotation), 0.8 * kDegree);
        widest = std::max(widest, now.rotation.angularDistance(rest.rotation));
        last = now;
    }
    EXPECT_GT(widest, 0.8 * kDegree);
}

TEST(SyntheticPath, TheRestPathDoesNotMoveAndTheRotationPathOnlyRotates) {
    const World world = makeWorld(Scene::Office, 1);
    const RigidTransform rest = cameraPose(world, Path::Rest, 1, 0);
    for (const double t : {0.5, 3.0, 7.7}) {
        const RigidTransform still = cameraPose(world, Path::Rest, 1, t);
        EXPECT_EQ(still.translation, rest.translation);
        EXPECT_EQ(still.rotation.angularDistance(rest.rotation), 0);
        EXPECT_EQ(cameraPose(world, Path::Rotate, 1, t).translation, rest.translation);
    }
    EXPECT_GT(cameraPose(world, Path::Rotate, 1, 2).rotation.angularDistance(rest.rotation),
              2 * kDegree);
}

TEST(SyntheticWorld, FirstViewShowsEveryTagUnoccluded) {
    for (const Scene scene : kAllScenes) {
        const World world = makeWorld(scene, 1);
        ASSERT_FALSE(world.tags.empty());
        Viewpoint view = small(world, Path::Rest, 0);
        view.camera = boardRig().video;
        const RigidTransform T_camera_world = view.T_world_camera.inverse();
        const FloatImage inverse = inverseDepth(world, view);
        for (const Tag& tag : world.tags) {
            const Eigen::Vector3d p = T_camera_world * tag.T_world_tag.translation;
            const Eigen::Vector2d q = view.camera.project({p.x() / p.z(), p.y() / p.z()});
            const int x = static_cast<int>(std::lround(q.x()));
            const int y = static_cast<int>(std::lround(q.y()));
            ASSERT_TRUE(x >= 0 && y >= 0 && x < 640 && y < 480) << name(scene) << tag.id;
            const Eigen::Vector3d n =
                (T_camera_world.rotation * tag.T_world_tag.rotation) * Eigen::Vector3d::UnitZ();
            const double expected = n.dot(ray(view.camera, x, y)) / n.dot(p);
            EXPECT_NEAR(inverse.at(x, y), expected, 1e-6 * expected) << name(scene) << tag.id;
        }
    }
}

TEST(SyntheticTruth, FlowIsTheReprojectionOfInverseDepth) {
    for (const Scene scene : {Scene::Office, Scene::Shelf, Scene::Outdoor}) {
        const World world = makeWorld(scene, 3);
        const Viewpoint a = small(world, Path::Handheld, 0.4), b = small(world, Path::Orbit, 1.3);
        const FloatImage inverse = inverseDepth(world, a);
        const FlowImage flow = flowBetween(world, a, b);
        const RigidTransform T_b_a = b.T_world_camera.inverse() * a.T_world_camera;
        int checked = 0;
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 160; ++x) {
                if (!known(flow.at(x, y))) continue;
                const Eigen::Vector3d q =
                    T_b_a.rotation * ray(a.camera, x, y) + inverse.at(x, y) * T_b_a.translation;
                const Eigen::Vector2d p = b.camera.project({q.x() / q.z(), q.y() / q.z()});
                ASSERT_NEAR(p.x() - x, flow.at(x, y)[0], 2e-4);
                ASSERT_NEAR(p.y() - y, flow.at(x, y)[1], 2e-4);
                ++checked;
            }
        }
        EXPECT_GT(checked, 160 * 120 / 2);
    }
}

TEST(SyntheticTruth, FlowUnderPureRotationDoesNotDependOnDepth) {
    const World office = makeWorld(Scene::Office, 1), shelf = makeWorld(Scene::Shelf, 1);
    Viewpoint a = small(office, Path::Rotate, 0), b = small(office, Path::Rotate, 0.7);
    const FlowImage first = flowBetween(office, a, b);
    const Eigen::Vector3d there = shelf.eye;
    a.T_world_camera.translation = b.T_world_camera.translation = there;
    const FlowImage second = flowBetween(shelf, a, b);
    int compared = 0;
    for (std::size_t i = 0; i < first.vectors.size(); ++i) {
        if (!known(first.vectors[i]) || !known(second.vectors[i])) continue;
        EXPECT_NEAR(first.vectors[i][0], second.vectors[i][0], 1e-4);
        EXPECT_NEAR(first.vectors[i][1], second.vectors[i][1], 1e-4);
        ++compared;
    }
    EXPECT_GT(compared, 10000);
}

TEST(SyntheticTruth, FlowOfOccludedAndOutsidePixelsIsUnknown) {
    const World world = makeWorld(Scene::Shelf, 1);
    const Viewpoint a = small(world, Path::Rest, 0);
    Viewpoint b = a;
    b.T_world_camera.translation += Eigen::Vector3d(0.08, 0, 0);
    const FloatImage inverse = inverseDepth(world, a);
    const FloatImage inverseThere = inverseDepth(world, b);
    const FlowImage flow = flowBetween(world, a, b);
    const RigidTransform T_b_a = b.T_world_camera.inverse() * a.T_world_camera;
    int hidden = 0;
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            const Eigen::Vector3d q = (T_b_a * (ray(a.camera, x, y) / inverse.at(x, y)).eval());
            const Eigen::Vector2d p = b.camera.project({q.x() / q.z(), q.y() / q.z()});
            const int px = static_cast<int>(std::lround(p.x()));
            const int py = static_cast<int>(std::lround(p.y()));
            if (px < 0 || py < 0 || px >= 160 || py >= 120) {
                EXPECT_FALSE(known(flow.at(x, y)));
                continue;
            }
            // Tests only points that are behind the surfaces of all 3x3 pixels around their
            // position in the second view. So the exact position of edges does not matter.
            bool behind = true;
            for (int i = 0; i < 9; ++i) {
                const int nx = std::clamp(px + i % 3 - 1, 0, 159);
                const int ny = std::clamp(py + i / 3 - 1, 0, 119);
                behind = behind && inverseThere.at(nx, ny) > 1.05 / q.z();
            }
            if (behind) {
                EXPECT_FALSE(known(flow.at(x, y))) << x << " " << y;
                ++hidden;
            }
        }
    }
    EXPECT_GT(hidden, 100);
}

TEST(SyntheticTruth, FlowFollowsAMovingObject) {
    const World world = makeWorld(Scene::Moving, 1);
    const Viewpoint a = small(world, Path::Rest, 0);
    Viewpoint b = a;
    b.t = 0.5;
    const FlowImage flow = flowBetween(world, a, b);
    const RigidTransform T_camera_world = a.T_world_camera.inverse();
    const Eigen::Vector3d before = T_camera_world * world.moverPivot;
    const Eigen::Vector3d after =
        T_camera_world * (world.moverPose(0.5) * world.moverPose(0).inverse() *
                          (world.moverPose(0) * world.moverPivot));
    const Eigen::Vector3d start = T_camera_world * (world.moverPose(0) * world.moverPivot);
    const Eigen::Vector2d from = a.camera.project({start.x() / start.z(), start.y() / start.z()});
    const Eigen::Vector2d to = a.camera.project({after.x() / after.z(), after.y() / after.z()});
    int moving = 0, resting = 0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const auto& v : flow.vectors) {
        if (!known(v)) continue;
        const Eigen::Vector2d u(v[0], v[1]);
        if (u.norm() < 1e-4) {
            ++resting;
        } else {
            ++moving;
            sum += u;
        }
    }
    EXPECT_GT(moving, 100);
    EXPECT_GT(resting, 10000);
    EXPECT_LT((sum / moving - (to - from)).norm(), 0.35 * (to - from).norm());
    EXPECT_GT(before.z(), 0);
}

}  // namespace
}  // namespace mfar::synthetic
