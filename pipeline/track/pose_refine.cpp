#include "pipeline/track/pose_refine.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace mfar {
namespace {

constexpr int kIterations = 30;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct NormalEquations {
    Matrix6 A = Matrix6::Zero();
    Vector6 b = Vector6::Zero();
};

// A ray flatter than that is not one through a lens.
bool inFront(const Eigen::Vector3d& p) {
    return p.z() > 1e-3 * p.norm();
}

double totalError(std::span<const CornerSet> sets, const RigidTransform& T_camera_world,
                  const CameraModel& camera) {
    double sum = 0;
    for (const CornerSet& set : sets)
        if (set.weight > 0) sum += set.weight * squaredError(set, T_camera_world, camera);
    return sum;
}

/// Linearised in x of T_world_camera * exp(x), which moves a point p of the camera's frame by
/// p x rotation - translation.
NormalEquations linearise(std::span<const CornerSet> sets, const RigidTransform& T_camera_world,
                          const CameraModel& camera) {
    NormalEquations out;
    for (const CornerSet& set : sets) {
        if (!(set.weight > 0)) continue;
        for (int k = 0; k < 4; ++k) {
            const Eigen::Vector3d p = T_camera_world * set.world[k];
            const Eigen::Vector2d ray = p.head<2>() / p.z();
            Eigen::Matrix<double, 2, 3> rayOfPoint;
            rayOfPoint << 1 / p.z(), 0, -ray.x() / p.z(), 0, 1 / p.z(), -ray.y() / p.z();
            Eigen::Matrix<double, 3, 6> pointOfMotion;
            pointOfMotion << skew(p), -Eigen::Matrix3d::Identity();
            const Eigen::Matrix<double, 2, 6> J =
                camera.projectJacobian(ray) * rayOfPoint * pointOfMotion;
            out.A += set.weight * J.transpose() * J;
            out.b += set.weight * J.transpose() * (set.pixels[k] - camera.project(ray));
        }
    }
    return out;
}

}  // namespace

double squaredError(const CornerSet& set, const RigidTransform& T_camera_world,
                    const CameraModel& camera) {
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d p = T_camera_world * set.world[k];
        if (!inFront(p)) return kInfinity;
        sum += (camera.project(p.head<2>() / p.z()) - set.pixels[k]).squaredNorm();
    }
    return sum;
}

std::optional<RefinedPose> refinePose(std::span<const CornerSet> sets, const RigidTransform& start,
                                      const CameraModel& camera) {
    RigidTransform T = start;
    double error = totalError(sets, T.inverse(), camera);
    if (!std::isfinite(error)) return std::nullopt;
    NormalEquations equations = linearise(sets, T.inverse(), camera);
    double damping = 1e-4;
    for (int i = 0; i < kIterations; ++i) {
        Matrix6 damped = equations.A;
        damped.diagonal() *= 1 + damping;
        const Vector6 step = damped.ldlt().solve(equations.b);
        if (!step.allFinite()) return std::nullopt;
        const RigidTransform next = T * exponential(step);
        const double nextError = totalError(sets, next.inverse(), camera);
        if (!(nextError <= error)) {
            damping *= 10;
            if (damping > 1e8) break;
            continue;
        }
        const double gained = error - nextError;
        T = next;
        error = nextError;
        equations = linearise(sets, T.inverse(), camera);
        damping = std::max(damping / 10, 1e-9);
        if (gained <= 1e-9 * error + 1e-14) break;
    }
    if (!isFinite(T) || !equations.A.allFinite()) return std::nullopt;
    return RefinedPose{T, equations.A, error};
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
