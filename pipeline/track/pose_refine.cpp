#include "pipeline/track/pose_refine.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar {
namespace {

constexpr int kIterations = 30;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

struct NormalEquations {
    Matrix7 A = Matrix7::Zero();
    Vector7 b = Vector7::Zero();
};

struct Estimate {
    RigidTransform T_world_camera;
    double edgeShift = 0;
};

// False if the point is behind the camera, or so far beside it (almost 90 degrees from the optical
// axis) that no lens sees it.
bool inFront(const Eigen::Vector3d& p) {
    return p.z() > 1e-3 * p.norm();
}

double totalError(std::span<const CornerSet> sets, const Estimate& at, const CameraModel& camera,
                  double shiftWeight) {
    const RigidTransform T_camera_world = at.T_world_camera.inverse();
    double sum = shiftWeight * at.edgeShift * at.edgeShift;
    for (const CornerSet& set : sets)
        if (set.weight > 0)
            sum += set.weight * squaredError(set, T_camera_world, camera, at.edgeShift);
    return sum;
}

/// Linearises the reprojection errors at the estimate `at`. The variables are the small motion x in
/// T_world_camera * exp(x), and the edge shift. The motion moves a point p in camera coordinates by
/// cross(p, rotation) - translation.
NormalEquations linearise(std::span<const CornerSet> sets, const Estimate& at,
                          const CameraModel& camera, double shiftWeight) {
    const RigidTransform T_camera_world = at.T_world_camera.inverse();
    NormalEquations out;
    out.A(6, 6) = shiftWeight;
    out.b(6) = -shiftWeight * at.edgeShift;
    for (const CornerSet& set : sets) {
        if (!(set.weight > 0)) continue;
        for (int k = 0; k < 4; ++k) {
            const Eigen::Vector3d p = T_camera_world * set.world[k];
            const Eigen::Vector2d ray = p.head<2>() / p.z();
            Eigen::Matrix<double, 2, 3> rayOfPoint;
            rayOfPoint << 1 / p.z(), 0, -ray.x() / p.z(), 0, 1 / p.z(), -ray.y() / p.z();
            Eigen::Matrix<double, 3, 6> pointOfMotion;
            pointOfMotion << skew(p), -Eigen::Matrix3d::Identity();
            Eigen::Matrix<double, 2, 7> J;
            J << camera.projectJacobian(ray) * rayOfPoint * pointOfMotion, set.outwards[k];
            const Eigen::Vector2d expected = camera.project(ray) + at.edgeShift * set.outwards[k];
            out.A += set.weight * J.transpose() * J;
            out.b += set.weight * J.transpose() * (set.pixels[k] - expected);
        }
    }
    return out;
}

Estimate moved(const Estimate& from, const Vector7& step) {
    return {from.T_world_camera * exponential(step.head<6>()), from.edgeShift + step(6)};
}

Eigen::Vector2d outwardNormal(const Eigen::Vector2d& edge) {
    return Eigen::Vector2d(-edge.y(), edge.x()).normalized();
}

}  // namespace

std::array<Eigen::Vector2d, 4> outwardsOf(const std::array<Eigen::Vector2d, 4>& corners) {
    std::array<Eigen::Vector2d, 4> out;
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d a = outwardNormal(corners[k] - corners[(k + 3) % 4]);
        const Eigen::Vector2d b = outwardNormal(corners[(k + 1) % 4] - corners[k]);
        // If the two edges at a corner move outwards by 1 px, the corner moves to their new
        // intersection. At a corner with a small angle (below 26 degrees), the intersection is
        // unstable, and the corner does not move.
        const double flat = 1 + a.dot(b);
        out[k] = flat > 0.1 ? Eigen::Vector2d((a + b) / flat) : Eigen::Vector2d::Zero();
    }
    return out;
}

double squaredError(const CornerSet& set, const RigidTransform& T_camera_world,
                    const CameraModel& camera, double edgeShift) {
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d p = T_camera_world * set.world[k];
        if (!inFront(p)) return kInfinity;
        const Eigen::Vector2d seen = set.pixels[k] - edgeShift * set.outwards[k];
        sum += (camera.project(p.head<2>() / p.z()) - seen).squaredNorm();
    }
    return sum;
}

std::optional<RefinedPose> refinePose(std::span<const CornerSet> sets, const RigidTransform& start,
                                      const CameraModel& camera, double shiftWeight) {
    Estimate at{start, 0};
    double error = totalError(sets, at, camera, shiftWeight);
    if (!std::isfinite(error)) return std::nullopt;
    NormalEquations equations = linearise(sets, at, camera, shiftWeight);
    double damping = 1e-4;
    for (int i = 0; i < kIterations; ++i) {
        Matrix7 damped = equations.A;
        damped.diagonal() *= 1 + damping;
        const Vector7 step = damped.ldlt().solve(equations.b);
        if (!step.allFinite()) return std::nullopt;
        const Estimate next = moved(at, step);
        const double nextError = totalError(sets, next, camera, shiftWeight);
        if (!(nextError <= error)) {
            damping *= 10;
            if (damping > 1e8) break;
            continue;
        }
        const double gained = error - nextError;
        at = next;
        error = nextError;
        equations = linearise(sets, at, camera, shiftWeight);
        damping = std::max(damping / 10, 1e-9);
        if (gained <= 1e-9 * error + 1e-14) break;
    }
    if (!isFinite(at.T_world_camera) || !equations.A.allFinite()) return std::nullopt;
    const Vector6 shared = equations.A.topRightCorner<6, 1>();
    const Matrix6 information =
        equations.A.topLeftCorner<6, 6>() - shared * shared.transpose() / equations.A(6, 6);
    return RefinedPose{at.T_world_camera, information, totalError(sets, at, camera, 0),
                       at.edgeShift};
}

std::optional<Matrix6> inverseOf(const Matrix6& information) {
    const Vector6 diagonal = information.diagonal();
    if (!(diagonal.minCoeff() > 0)) return std::nullopt;
    const Vector6 scale = diagonal.cwiseSqrt().cwiseInverse();
    const Matrix6 unit = scale.asDiagonal() * information * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(unit);
    if (!(eigen.eigenvalues()(0) > 1e-13)) return std::nullopt;
    Matrix6 out = scale.asDiagonal() * eigen.eigenvectors() *
                  eigen.eigenvalues().cwiseInverse().asDiagonal() *
                  eigen.eigenvectors().transpose() * scale.asDiagonal();
    out = 0.5 * (out + out.transpose()).eval();
    if (!out.allFinite()) return std::nullopt;
    return out;
}

}  // namespace mfar
