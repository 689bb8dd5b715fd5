#include "daemon/tools/calibrate/rig_bundle.h"

#include "base/se3.h"
#include "daemon/tools/calibrate/camera_fit.h"
#include "daemon/tools/calibrate/pose_track.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace mfar::calibration {
namespace {

constexpr double kHuber = 2.5;  // a corner's cost grows linearly above this residual [sigma]
constexpr int kIterations = 40;
constexpr double kConverged = 1e-9;  // iteration ends at a smaller relative decrease of the cost
constexpr double kStep = 1e-6;       // step of the numeric derivatives of poses [rad, m, s]

using Vector9 = Eigen::Matrix<double, 9, 1>;

struct Projected {
    Eigen::Vector2d pixel;
    Eigen::Matrix<double, 2, 9> byCamera;
    Eigen::Matrix<double, 2, 3> byPoint;
};

Projected project(const CameraModel& c, const Eigen::Vector3d& p) {
    const double x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
    Projected out;
    out.pixel = c.project({x, y});
    const double u = (out.pixel.x() - c.cx) / c.fx, v = (out.pixel.y() - c.cy) / c.fy;
    out.byCamera << u, 0, 1, 0, c.fx * x * r2, c.fx * x * r2 * r2, 2 * c.fx * x * y,
        c.fx * (r2 + 2 * x * x), c.fx * x * r2 * r2 * r2, 0, v, 0, 1, c.fy * y * r2,
        c.fy * y * r2 * r2, c.fy * (r2 + 2 * y * y), 2 * c.fy * x * y, c.fy * y * r2 * r2 * r2;
    Eigen::Matrix<double, 2, 3> rayByPoint;
    rayByPoint << 1 / p.z(), 0, -x / p.z(), 0, 1 / p.z(), -y / p.z();
    out.byPoint = c.projectJacobian({x, y}) * rayByPoint;
    return out;
}

void move(CameraModel& c, const Vector9& step) {
    c.fx += step[0];
    c.fy += step[1];
    c.cx += step[2];
    c.cy += step[3];
    for (int i = 0; i < 5; ++i)
        c.distortion[i] += step[4 + i];
}

RigidTransform moved(const RigidTransform& T, const Vector6& step) {
    return exponential(step) * T;
}

}  // namespace

RigBundle::RigBundle(const Target& target, const StereoRig& rig, double offset)
    : target_(&target), rig_(rig), offset_(offset) {}

int RigBundle::addPose(const RigidTransform& start) {
    poses_.push_back(start);
    return static_cast<int>(poses_.size()) - 1;
}

int RigBundle::addView(bool still, const std::vector<Corner>& corners, int pose) {
    views_.push_back({still, false, &corners, {pose}, {}});
    return static_cast<int>(views_.size()) - 1;
}

int RigBundle::addTied(const std::vector<Corner>& corners, const std::array<int, 4>& poses,
                       const std::array<double, 4>& times) {
    views_.push_back({true, true, &corners, poses, times});
    return static_cast<int>(views_.size()) - 1;
}

RigidTransform RigBundle::poseOf(const View& view) const {
    if (!view.tied) return poses_[view.poses[0]];
    std::array<RigidTransform, 4> poses;
    for (int j = 0; j < 4; ++j)
        poses[j] = poses_[view.poses[j]];
    return rig_.T_still_video * between(poses, view.times, offset_);
}

std::vector<Eigen::Vector2d> RigBundle::residuals(int view) const {
    const View& v = views_[view];
    return residualsOf(*target_, {{}, *v.corners}, cameraOf(v), poseOf(v));
}

double RigBundle::cost(const std::array<double, 2>& sigma) const {
    double sum = 0;
    for (const View& view : views_) {
        const RigidTransform T = poseOf(view);
        for (const Corner& c : *view.corners) {
            const Eigen::Vector3d p = T * target_->points[c.index];
            if (!(p.z() > 0)) return std::numeric_limits<double>::infinity();
            const double e =
                (c.pixel - cameraOf(view).project(p.head<2>() / p.z())).norm() / sigma[view.still];
            sum += e <= kHuber ? 0.5 * e * e : kHuber * (e - 0.5 * kHuber);
        }
    }
    return sum;
}

/// Returns the derivative of a view's pose with respect to the parameters on which it depends. The
/// change of the pose is expressed as a motion in the camera's frame. If the view has a pose of its
/// own, this pose is the parameter. If its pose is interpolated, the parameters are the extrinsics,
/// the clock offset and the four poses between which it is interpolated.
Eigen::MatrixXd RigBundle::poseJacobian(const View& view) const {
    if (!view.tied) return Matrix6::Identity();
    Eigen::MatrixXd out(6, 31);
    out.leftCols<6>().setIdentity();
    std::array<RigidTransform, 4> poses;
    for (int j = 0; j < 4; ++j)
        poses[j] = poses_[view.poses[j]];
    const auto difference = [&](const auto& perturbed) {
        const RigidTransform plus = rig_.T_still_video * perturbed(kStep);
        const RigidTransform minus = rig_.T_still_video * perturbed(-kStep);
        return Vector6(logarithm(plus * minus.inverse()) / (2 * kStep));
    };
    out.col(6) = difference([&](double h) { return between(poses, view.times, offset_ + h); });
    for (int j = 0; j < 4; ++j) {
        for (int k = 0; k < 6; ++k) {
            out.col(7 + 6 * j + k) = difference([&](double h) {
                auto changed = poses;
                changed[j] = moved(poses[j], h * Vector6::Unit(k));
                return between(changed, view.times, offset_);
            });
        }
    }
    return out;
}

void RigBundle::linearise(const View& view, double sigma, Linear& out) const {
    const Eigen::MatrixXd byPose = poseJacobian(view);
    const auto m = static_cast<int>(9 + byPose.cols());
    std::vector<int> columns;
    for (int k = 0; k < 9; ++k)
        columns.push_back((view.still ? kStillAt : 0) + k);
    for (int k = kExtrinsicAt; view.tied && k < kShared; ++k)
        columns.push_back(k);
    for (int j = 0; j < (view.tied ? 4 : 1); ++j)
        for (int k = 0; k < 6; ++k)
            columns.push_back(kShared + 6 * view.poses[j] + k);
    const RigidTransform T = poseOf(view);
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(m, m);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(m);
    Eigen::MatrixXd J(2, m);
    for (const Corner& c : *view.corners) {
        const Eigen::Vector3d p = T * target_->points[c.index];
        const Projected at = project(cameraOf(view), p);
        Eigen::Matrix<double, 3, 6> byMotion;
        byMotion << -skew(p), Eigen::Matrix3d::Identity();
        J.leftCols<9>() = at.byCamera;
        J.rightCols(m - 9) = at.byPoint * byMotion * byPose;
        const Eigen::Vector2d r = (c.pixel - at.pixel) / sigma;
        const double weight = r.norm() <= kHuber ? 1 : kHuber / r.norm();
        H.noalias() += weight / (sigma * sigma) * J.transpose() * J;
        g.noalias() += weight / sigma * J.transpose() * r;
    }
    for (int a = 0; a < m; ++a) {
        out.g[columns[a]] += g[a];
        for (int b = 0; b < m; ++b)
            out.H(columns[a], columns[b]) += H(a, b);
    }
}

RigBundle::Linear RigBundle::linearise(const std::array<double, 2>& sigma,
                                       const std::array<bool, kShared>& fixed) const {
    Linear out{Eigen::MatrixXd::Zero(columns(), columns()), Eigen::VectorXd::Zero(columns())};
    for (const View& view : views_)
        linearise(view, sigma[view.still], out);
    for (int k = 0; k < kShared; ++k) {
        if (!fixed[k]) continue;
        out.H.row(k).setZero();
        out.H.col(k).setZero();
        out.H(k, k) = 1;
        out.g[k] = 0;
    }
    return out;
}

void RigBundle::apply(const Eigen::VectorXd& step) {
    move(rig_.video, step.head<9>());
    move(rig_.still, step.segment<9>(kStillAt));
    rig_.T_still_video = moved(rig_.T_still_video, step.segment<6>(kExtrinsicAt));
    offset_ += step[kOffsetAt];
    for (std::size_t i = 0; i < poses_.size(); ++i)
        poses_[i] = moved(poses_[i], step.segment<6>(kShared + 6 * static_cast<Eigen::Index>(i)));
}

void RigBundle::solve(const std::array<double, 2>& sigma, const std::array<bool, kShared>& fixed) {
    double lambda = 1e-4, now = cost(sigma);
    Linear linear = linearise(sigma, fixed);
    for (int i = 0; i < kIterations; ++i) {
        Eigen::MatrixXd damped = linear.H;
        damped.diagonal() *= 1 + lambda;
        const RigBundle before = *this;
        apply(damped.llt().solve(linear.g));
        const double then = cost(sigma);
        if (!(then < now)) {
            rig_ = before.rig_;
            offset_ = before.offset_;
            poses_ = before.poses_;
            lambda *= 10;
            if (lambda > 1e6) break;
            continue;
        }
        const bool converged = now - then < kConverged * now;
        now = then;
        lambda = std::max(1e-9, lambda / 10);
        linear = linearise(sigma, fixed);
        if (converged) break;
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(linear.H);
    const Eigen::MatrixXd covariance =
        factor.solve(Eigen::MatrixXd::Identity(columns(), kShared)).topRows(kShared);
    if (factor.info() != Eigen::Success || !covariance.allFinite() || !std::isfinite(now))
        throw Unsuitable("the views do not determine the lenses and the distance of the two "
                         "sensors; take pictures of the target from more directions");
    for (int k = 0; k < kShared; ++k)
        deviations_[k] = fixed[k] ? 0 : std::sqrt(std::max(0., covariance(k, k)));
}

}  // namespace mfar::calibration
