#include "pipeline/slices/view_change.h"

#include "base/se3.h"
#include "pipeline/render/lens_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mfar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Two cones around the optical axis. `inner` is the largest cone inside the field of view; `outer`
/// is the smallest cone that contains the field of view.
struct ViewCones {
    double inner = std::numbers::pi, outer = 0;  // half angles [rad]

    explicit ViewCones(const CameraModel& camera) {
        const double right = camera.size.width - 0.5, bottom = camera.size.height - 0.5;
        for (const double x : {-0.5, camera.cx, right})
            for (const double y : {-0.5, camera.cy, bottom}) {
                if (x == camera.cx && y == camera.cy) continue;
                const double angle = std::atan(camera.unproject({x, y}).norm());
                inner = std::min(inner, angle);
                outer = std::max(outer, angle);
            }
    }
};

struct BallSight {
    Eigen::Vector3d towards;  // from the camera to the ball's centre, in the camera frame [m]
    double fromAxis = 0, halfAngle = 0;

    BallSight(const RenderView& view, const ObjectBall& ball)
        : towards(view.T_world_camera.inverse() * ball.centre),
          fromAxis(angleBetween(Eigen::Vector3d::UnitZ(), towards)),
          halfAngle(towards.norm() > ball.radius ? std::asin(ball.radius / towards.norm())
                                                 : std::numbers::pi) {}

    [[nodiscard]] bool seen(const ViewCones& cones) const {
        return fromAxis - halfAngle < cones.outer;
    }
    [[nodiscard]] bool whole(const ViewCones& cones) const {
        return fromAxis + halfAngle < cones.inner;
    }
};

/// Coefficients of the light in spherical harmonics of degree 0 and 1, without constant factors.
/// Row 0 is the mean, rows 1 to 3 are the x, y and z components. The columns are colour channels.
using LightMoments = Eigen::Matrix<double, 4, 3>;

LightMoments momentsOf(const Environment& environment) {
    LightMoments out = LightMoments::Zero();
    const auto [width, height] = environment.size;
    for (int row = 0; row < height; ++row) {
        const double polar = std::numbers::pi * (row + 0.5) / height;
        const double solidAngle = std::sin(polar) * 2 * std::numbers::pi * std::numbers::pi /
                                  (static_cast<double>(width) * height);
        for (int column = 0; column < width; ++column) {
            // In the world frame, column 0 is at -x, and the column at 3/4 of the width is at +y.
            const double around = 2 * std::numbers::pi * (column + 0.5) / width - std::numbers::pi;
            const Eigen::Vector4d basis{1, std::sin(polar) * std::cos(around),
                                        std::sin(polar) * std::sin(around), std::cos(polar)};
            const auto texel = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(column);
            out += solidAngle * basis * environment.radiance[texel].cast<double>().transpose();
        }
    }
    return out;
}

LightMoments momentsOf(const Lighting& light) {
    LightMoments out = LightMoments::Zero();
    if (light.environment) out = momentsOf(*light.environment);
    if (light.sun) {
        Eigen::Vector4d basis;
        basis << 1, light.sun->towards.cast<double>();
        out += basis * light.sun->irradiance.cast<double>().transpose();
    }
    return out;
}

}  // namespace

double viewChange(const RenderView& from, const RenderView& to, std::span<const ObjectBall> objects,
                  const ViewLimits& limits) {
    if (!(from.camera == to.camera)) return kInfinity;
    const ViewCones cones(from.camera);
    const double turnLimit = limits.turnDegrees * std::numbers::pi / 180;
    double change = 0;
    for (const ObjectBall& ball : objects) {
        const BallSight before(from, ball), after(to, ball);
        if (!after.seen(cones)) continue;
        if (!before.seen(cones)) return kInfinity;
        if (!before.whole(cones))
            change = std::max(change, angleBetween(before.towards, after.towards) / turnLimit);
        const Eigen::Vector3d a = from.T_world_camera.translation - ball.centre;
        const Eigen::Vector3d b = to.T_world_camera.translation - ball.centre;
        change = std::max(change, angleBetween(a, b) / turnLimit);
        const double nearer = std::min(a.norm(), b.norm()), farther = std::max(a.norm(), b.norm());
        if (farther > nearer) change = std::max(change, (farther / nearer - 1) / limits.zoom);
    }
    return change;
}

bool isSeen(std::span<const ObjectBall> balls, const RenderView& view) {
    const ViewCones cones(view.camera);
    return std::ranges::any_of(
        balls, [&](const ObjectBall& ball) { return BallSight(view, ball).seen(cones); });
}

double pixelChange(const RenderView& from, const RenderView& to,
                   std::span<const ObjectBall> objects) {
    if (!(from.camera == to.camera)) return kInfinity;
    const RigidTransform before = from.T_world_camera.inverse(),
                         after = to.T_world_camera.inverse();
    const Eigen::Vector2d focal{from.camera.fx, from.camera.fy};
    double change = 0;
    for (const ObjectBall& ball : objects)
        for (int i = 0; i < 7; ++i) {
            Eigen::Vector3d point = ball.centre;
            if (i > 0) point[(i - 1) / 2] += (i % 2 == 0 ? -1 : 1) * ball.radius;
            const Eigen::Vector3d a = before * point, b = after * point;
            if (!(a.z() > 0 && b.z() > 0)) continue;
            const Eigen::Vector2d moved = b.hnormalized() - a.hnormalized();
            change = std::max(change, moved.cwiseProduct(focal).norm());
        }
    return change;
}

double lightChange(const Lighting& a, const Lighting& b) {
    const bool sameSun =
        a.sun.has_value() == b.sun.has_value() &&
        (!a.sun || (a.sun->towards == b.sun->towards && a.sun->irradiance == b.sun->irradiance));
    if (a.environment == b.environment && sameSun) return 0;
    const LightMoments before = momentsOf(a), after = momentsOf(b);
    const double most = std::max(before.row(0).maxCoeff(), after.row(0).maxCoeff());
    return most > 0 ? (after - before).cwiseAbs().maxCoeff() / most : 0;
}

bool sameObjects(const Scene& a, const Scene& b) {
    return a.objects == b.objects && a.catcher.positions == b.catcher.positions &&
           a.catcher.triangles == b.catcher.triangles && a.catcher.albedo == b.catcher.albedo;
}

bool isUsable(const RenderView& view) {
    return isSound(view.camera) && isFinite(view.T_world_camera) &&
           view.T_world_camera.rotation.norm() > 0;
}

}  // namespace mfar
