#include "pipeline/composite/lens_projection.h"
#include "pipeline/track/pose_estimator.h"
#include "pipeline/track/tracker.h"
#include "tests/stability/cases.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace mfar::stress {
namespace {

/// A camera at this distance from a tag at the world's origin. The tag is tilted by up to 70
/// degrees.
RigidTransform before(Context& c, double distance) {
    const Eigen::AngleAxisd tilt(
        c.hostile.real(-1.2, 1.2),
        Eigen::Vector3d(c.hostile.real(-1, 1), c.hostile.real(-1, 1), 0).normalized());
    RigidTransform T_camera_world{Eigen::Quaterniond(tilt), {0, 0, distance}};
    T_camera_world.translation.x() = distance * c.hostile.real(-0.2, 0.2);
    return T_camera_world.inverse();
}

TagObservation observed(Context& c, const CameraModel& camera, const RigidTransform& T_world_camera,
                        double size, double noise) {
    TagObservation out;
    out.size = size;
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d corner = kTagCorners[k] * size / 2;
        const Eigen::Vector3d p =
            T_world_camera.inverse() * Eigen::Vector3d(corner.x(), corner.y(), 0);
        out.corners[k] = camera.project(p.hnormalized()) +
                         noise * Eigen::Vector2d(c.hostile.real(-1, 1), c.hostile.real(-1, 1));
    }
    return out;
}

CameraModel tagCamera(Context& c) {
    CameraModel camera = c.hostile.camera({640, 480});
    camera.fx = camera.fy = c.hostile.real(500, 900);
    for (double& d : camera.distortion)
        d *= 0.5;
    return camera;
}

void checkPose(Context& c, const RigidTransform& T, const Matrix6& covariance) {
    c.checks.require(isFinite(T), "a pose that is not finite");
    c.checks.within(T.rotation.norm(), 1 - 1e-9, 1 + 1e-9, "norm of a rotation");
    c.checks.require(covariance.allFinite() && covariance.diagonal().minCoeff() >= 0,
                     "a pose's covariance is not finite or has a negative variance");
}

// Exact corners must give the exact pose, in any unit of length.
void exactTag(Context& c) {
    const CameraModel camera = tagCamera(c);
    const double unit = c.hostile.pick({1e-6, 1e-3, 1.0, 1e3});
    const RigidTransform truth = before(c, unit * c.hostile.real(0.3, 0.8));
    const TagObservation tag = observed(c, camera, truth, 0.12 * unit, 0);
    const auto poses = solveTagPose(std::span(&tag, 1), camera);
    c.checks.tried("solveTagPose", 1);
    const bool inside = std::ranges::all_of(tag.corners, [](const Eigen::Vector2d& p) {
        return p.x() >= 0 && p.y() >= 0 && p.x() <= 639 && p.y() <= 479;
    });
    c.checks.require(poses.has_value() || !inside, "no pose was found although the tag is in view");
    if (!poses) return;
    const double turn = poses->best.T_world_camera.rotation.angularDistance(truth.rotation);
    const double off = (poses->best.T_world_camera.translation - truth.translation).norm() / unit;
    c.checks.within(poses->best.rms(), 0, 1e-4, "error of exact corners [px]");
    c.checks.within(turn, 0, 1e-4, "rotation error with exact corners [rad]");
    c.checks.within(off, 0, 1e-4, "position error with exact corners, relative to the unit");
    checkPose(c, poses->best.T_world_camera, poses->best.covariance);
}

void spoil(Context& c, TagObservation& tag) {
    switch (c.hostile.integer(0, 5)) {
    case 0: tag.corners[c.hostile.integer(0, 3)].x() = c.hostile.bad(); break;
    case 1: tag.corners[1] = tag.corners[0]; break;
    case 2: tag.corners[2] = 0.5 * (tag.corners[1] + tag.corners[3]); break;
    case 3: tag.size = c.hostile.bad(); break;
    case 4: tag.T_world_tag = c.hostile.spoilt(tag.T_world_tag); break;
    default: std::swap(tag.corners[0], tag.corners[c.hostile.integer(1, 3)]); break;
    }
}

void hostileTags(Context& c) {
    CameraModel camera = tagCamera(c);
    if (c.hostile.chance(0.1)) camera.fx = c.hostile.bad();
    if (c.hostile.chance(0.1)) camera.distortion[c.hostile.integer(0, 4)] = c.hostile.real(-5, 5);
    PoseEstimator estimator;
    Timestamp time{};
    for (int frame = 0; frame < 20; ++frame) {
        time =
            time + std::chrono::milliseconds(c.hostile.pick({33, 33, 33, 0, -33, 1000, 10000000}));
        std::vector<TagObservation> tags;
        const RigidTransform truth = before(c, c.hostile.real(0.2, 1));
        for (int i = c.hostile.integer(0, 3); i > 0; --i) {
            tags.push_back(observed(c, camera, truth, 0.1, c.hostile.pick({0.0, 0.2, 30.0})));
            if (c.hostile.chance(0.3)) spoil(c, tags.back());
        }
        const auto pose = estimator.update(tags, camera, time);
        if (pose) checkPose(c, pose->T_world_video, pose->covariance);
        if (estimator.raw())
            checkPose(c, estimator.raw()->T_world_video, estimator.raw()->covariance);
        c.checks.tried("PoseEstimator", static_cast<long>(tags.size()));
    }
}

void hostilePoseFilter(Context& c) {
    PoseFilter filter;
    Timestamp time{};
    for (int frame = 0; frame < 40; ++frame) {
        time = time + std::chrono::nanoseconds(c.hostile.pick<std::int64_t>(
                          {33000000, 1, 0, -1, 400000000, 1000000000000}));
        Pose measured{time, c.hostile.chance(0.8) ? c.hostile.gentle() : c.hostile.motion()};
        if (c.hostile.chance(0.2))
            measured.T_world_video = c.hostile.spoilt(measured.T_world_video);
        measured.covariance = c.hostile.covariance();
        if (c.hostile.chance(0.8))
            (void)filter.update(measured, c.hostile.chance(0.2) ? c.hostile.bad() : 1.0);
        else
            filter.missed();
        const auto pose =
            filter.predict(time + std::chrono::milliseconds(c.hostile.integer(-50, 50)));
        if (pose) checkPose(c, pose->T_world_video, pose->covariance);
        c.checks.tried("PoseFilter", 1);
    }
}

void hostileTracker(Context& c) {
    const Size size = c.size(1, 150);
    const CameraModel camera = c.hostile.camera(size);
    Tracker tracker({camera, camera, {}}, {});
    Timestamp time{};
    for (int frame = 0; frame < 2; ++frame) {
        time = time + std::chrono::milliseconds(33);
        const TestPicture picture = c.hostile.picture(size, PixelFormat::Gray8);
        if (const auto pose = tracker.track(picture.view(), time))
            checkPose(c, pose->T_world_video, pose->covariance);
        if (const auto pose = tracker.trackStill(picture.view(), time))
            checkPose(c, pose->T_world_video, pose->covariance);
        c.checks.through("Tracker", pixelsOf(size));
    }
}

// Unprojecting and then projecting a pixel must give the same pixel. LensProjection must give
// finite results for all points, also for rays outside the lens model's valid range.
void lenses(Context& c) {
    const CameraModel camera = c.hostile.camera(c.hostile.size(1, 2000));
    const LensProjection lens(camera);
    for (int i = 0; i < 200; ++i) {
        const Eigen::Vector2d pixel(c.hostile.real(0, camera.size.width - 1),
                                    c.hostile.real(0, camera.size.height - 1));
        const Eigen::Vector2d ray = camera.unproject(pixel);
        c.checks.require(ray.allFinite(), "a ray that is not finite");
        // In corners of the picture that are beyond the lens model's valid range, unproject()
        // returns a ray at the limit of this range. These corners are skipped.
        if (camera.projectJacobian(ray).determinant() > 0.1 * camera.fx * camera.fy)
            c.checks.within((camera.project(ray) - pixel).norm(), 0, 1e-6,
                            "shift of an unprojected and projected pixel [px]");
        const double z = c.hostile.pick({1.0, 1e-6, -1e-6, -1.0, 1e6, 1e-30});
        const Eigen::Vector3d p = lens({c.hostile.real(-2, 2), c.hostile.real(-2, 2), z});
        c.checks.require(p.allFinite() && p.z() == z,
                         "a projected point is not finite or has another depth");
    }
    c.checks.tried("lens", 200);
}

}  // namespace

std::vector<Case> poseCases() {
    return {{"tag-exact", exactTag},
            {"tags", hostileTags},
            {"pose-filter", hostilePoseFilter},
            {"tracker", hostileTracker, true},
            {"lens", lenses}};
}

}  // namespace mfar::stress
