#include "hal/virtual/synthetic_ray.h"

#include <cmath>
#include <limits>

namespace mfar::synthetic {
namespace {

/// The interval of a ray that is inside a convex solid, and the axis of the face through which the
/// ray enters.
struct Interval {
    double enter = -std::numeric_limits<double>::infinity();
    double leave = std::numeric_limits<double>::infinity();
    int axis = 0;

    void clip(double from, double to, int faceAxis) {
        if (from > enter) {
            enter = from;
            axis = faceAxis;
        }
        if (to < leave) leave = to;
    }
    void miss() { leave = -std::numeric_limits<double>::infinity(); }
};

void clipSlab(Interval& in, double o, double d, int axis) {
    if (d == 0) {
        if (!(std::abs(o) <= 1)) in.miss();
        return;
    }
    const double middle = -o / d, half = 1 / std::abs(d);
    in.clip(middle - half, middle + half, axis);
}

/// Clips the interval to the unit sphere, or, if `sphere` is false, to an infinite cylinder of
/// radius 1 along z.
void clipRound(Interval& in, Eigen::Vector3d o, Eigen::Vector3d d, bool sphere) {
    if (!sphere) o.z() = d.z() = 0;
    const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - 1;
    const double disc = b * b - a * c;
    if (!(disc > 0) || !(a > 0)) {
        if (!(a == 0 && c < 0)) in.miss();
        return;
    }
    const double root = std::sqrt(disc);
    in.clip((-b - root) / a, (-b + root) / a, 0);
}

Interval inside(Shape shape, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    Interval in;
    if (shape == Shape::Box) {
        clipSlab(in, o.x(), d.x(), 0);
        clipSlab(in, o.y(), d.y(), 1);
    } else {
        clipRound(in, o, d, shape == Shape::Ellipsoid);
    }
    if (shape != Shape::Ellipsoid) clipSlab(in, o.z(), d.z(), 2);
    return in;
}

}  // namespace

Snapshot::Snapshot(const World& world, double t) {
    for (int i = 0; i < static_cast<int>(world.primitives.size()); ++i) {
        const Primitive& p = world.primitives[i];
        const RigidTransform pose = world.primitivePose(i, t);
        solids_.push_back(
            {p.shape, pose,
             p.half.cwiseInverse().asDiagonal() * pose.rotation.conjugate().toRotationMatrix(),
             p.half, p.half.norm()});
        all_.push_back(i);
    }
}

std::optional<Hit> Snapshot::cast(const Ray& ray, double limit) const {
    return cast(ray, limit, all_);
}

bool Snapshot::blocked(const Ray& ray, double limit, int except) const {
    return blocked(ray, limit, except, all_);
}

std::optional<Hit> Snapshot::cast(const Ray& ray, double limit, std::span<const int> among) const {
    Hit best;
    best.distance = limit;
    bool found = false;
    const double length2 = ray.direction.squaredNorm();
    for (const int i : among) {
        const Solid& s = solids_[i];
        const Eigen::Vector3d toCentre = s.T_world_prim.translation - ray.origin;
        const double along = toCentre.dot(ray.direction);
        if (toCentre.squaredNorm() * length2 - along * along > s.radius * s.radius * length2)
            continue;
        const Eigen::Vector3d o = s.toUnit * -toCentre, d = s.toUnit * ray.direction;
        const Interval in = inside(s.shape, o, d);
        if (!(in.enter < in.leave && in.enter > 0 && in.enter < best.distance)) continue;
        const Eigen::Vector3d unit = o + in.enter * d;
        int axis = in.axis;
        if (s.shape == Shape::Ellipsoid) unit.cwiseAbs().maxCoeff(&axis);
        best = {in.enter, i, axis, unit[axis] > 0, unit.cwiseProduct(s.half)};
        found = true;
    }
    if (!found) return std::nullopt;
    return best;
}

bool Snapshot::blocked(const Ray& ray, double limit, int except, std::span<const int> among) const {
    const double length2 = ray.direction.squaredNorm();
    for (const int i : among) {
        if (i == except) continue;
        const Solid& s = solids_[i];
        const Eigen::Vector3d toCentre = s.T_world_prim.translation - ray.origin;
        const double along = toCentre.dot(ray.direction);
        if (toCentre.squaredNorm() * length2 - along * along > s.radius * s.radius * length2)
            continue;
        const Interval in = inside(s.shape, s.toUnit * -toCentre, s.toUnit * ray.direction);
        if (in.enter < in.leave && in.leave > 1e-6 && in.enter < limit) return true;
    }
    return false;
}

}  // namespace mfar::synthetic
