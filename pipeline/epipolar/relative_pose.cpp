#include "pipeline/epipolar/relative_pose.h"

#include "pipeline/epipolar/near_plane.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace mfar {
namespace {

using Matrix26 = Eigen::Matrix<double, 2, 6>;
using Matrix23 = Eigen::Matrix<double, 2, 3>;

constexpr int kMostSolves = 15;
constexpr double kSettled = 0.01;  // a step shorter than this ends the refinement [px]
// A refinement is accepted only with at least this number of inliers, and at least this share of
// the matches.
constexpr int kFewest = 16;
constexpr double kFewestShare = 0.4;
// A match whose error exceeds this number of standard deviations has no weight.
constexpr double kTukey = 4.685;
// Standard deviation of a good match [px]. Robust weights assume at least half of this value, even
// if the matches fit better.
constexpr double kMatchError = 0.3;
constexpr double kExplained = 1;       // the error of an inlier is below this [px]
constexpr double kNotExplained = 1e6;  // error of a match that fits no pose [px]

/// The estimated motion of points from the frame's camera to the still camera. Its rotation is
/// relative to the rotation of the prior pose. The unit of length is Solver::unit_.
struct Estimate {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d translation;
};

/// Residual of a match under an estimated pose. The inverse depth of the match is the one with the
/// smallest residual.
struct Residual {
    Eigen::Vector2d error;  // predicted minus matched ray (x/z, y/z)
    // Derivatives with respect to rotation and translation. The inverse depth is eliminated.
    Matrix26 jacobian;
};

Matrix23 rayOfPoint(const Eigen::Vector2d& ray, double z) {
    Matrix23 out;
    out << 1, 0, -ray.x(), 0, 1, -ray.y();
    return out / z;
}

// Computes the residual of a match. Near the epipole, depth hardly moves the point, so some extreme
// depth could explain any error. Therefore, the inverse depth has a prior with mean zero and a
// standard deviation of one per unit of length, which keeps it small there.
std::optional<Residual> residualOf(const RayMatch& match, const Estimate& at, double focal) {
    const double held = std::pow(kMatchError / focal, 2);
    const Eigen::Vector3d turned = at.rotation * match.video.homogeneous();
    const Eigen::Vector2d& seen = match.still;
    const Eigen::Vector2d apart = turned.head<2>() - seen * turned.z();
    const Eigen::Vector2d way = at.translation.head<2>() - seen * at.translation.z();
    const double inverseDepth = -apart.dot(way) / (way.squaredNorm() + held);
    const Eigen::Vector3d point = turned + inverseDepth * at.translation;
    if (!(point.z() > kNearPlane)) return std::nullopt;
    const Eigen::Vector2d ray = point.hnormalized();
    const Matrix23 byPoint = rayOfPoint(ray, point.z());
    Residual out;
    out.error = ray - seen;
    out.jacobian << -byPoint * skew(turned), inverseDepth * byPoint;
    const Eigen::Vector2d byDepth = byPoint * at.translation;
    const Eigen::RowVector2d share = byDepth.transpose() / (byDepth.squaredNorm() + held);
    out.jacobian -= byDepth * (share * out.jacobian);
    return out;
}

double quantileOf(std::vector<double> values, double quantile) {
    if (values.empty()) return 0;
    const auto place = static_cast<std::ptrdiff_t>(quantile * static_cast<double>(values.size()));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[place];
}

/// Robust Gauss-Newton solver. Rotations are in radians. The unit of length is the length of the
/// prior's translation or the standard deviation of this translation, whichever is larger.
class Solver {
public:
    Solver(std::span<const RayMatch> matches, const PosePrior& prior, double focal)
        : matches_(matches), focal_(focal) {
        const double length =
            std::max(prior.translation.norm(),
                     std::sqrt(prior.covariance.bottomRightCorner<3, 3>().trace()));
        unit_ = length > 0 ? length : 1;
        Vector6 scale = Vector6::Ones();
        scale.tail<3>().setConstant(1 / unit_);
        Matrix6 covariance = scale.asDiagonal() * prior.covariance * scale.asDiagonal();
        // An unknown can have a variance of zero in the prior. Its standard deviation is set to a
        // millionth, so that the covariance can be inverted.
        covariance.diagonal().array() += 1e-12;
        const Eigen::LLT<Matrix6> factors(covariance);
        usable_ = covariance.allFinite() && prior.translation.allFinite() &&
                  factors.info() == Eigen::Success;
        information_ = factors.solve(Matrix6::Identity());
        start_ = at_.translation = prior.translation / unit_;
    }

    [[nodiscard]] bool usable() const { return usable_; }
    [[nodiscard]] bool settled() const { return settled_; }
    [[nodiscard]] double median() const { return quantileOf(errors_, 0.5); }
    [[nodiscard]] RigidTransform motion() const {
        return {at_.rotation, unit_ * motion_.tail<3>()};
    }
    [[nodiscard]] int inliers() const {
        return static_cast<int>(std::count_if(errors_.begin(), errors_.end(),
                                              [&](double error) { return error < kExplained; }));
    }

    void measure() {
        residuals_.clear();
        errors_.clear();
        for (const RayMatch& match : matches_) {
            residuals_.push_back(residualOf(match, at_, focal_));
            const auto& r = residuals_.back();
            const double error = r ? focal_ * r->error.norm() : kNotExplained;
            errors_.push_back(error < kNotExplained ? error : kNotExplained);
        }
        // The scale of the errors is computed from a quantile below one half, so it is correct even
        // if slightly more than half of the matches are outliers. kNormal is the same quantile of
        // the absolute value of a standard normal variable.
        constexpr double kQuantile = 0.4, kNormal = 0.5244;
        scale_ = std::clamp(quantileOf(errors_, kQuantile) / kNormal, 0.5 * kMatchError, scale_);
    }

    /// Returns false if no Gauss-Newton step is possible.
    bool step() {
        Matrix6 A = information_;
        Vector6 b = -information_ * motion_;
        for (std::size_t i = 0; i < residuals_.size(); ++i) {
            const auto& r = residuals_[i];
            const double u = errors_[i] / (kTukey * scale_);
            if (!r || !(u < 1)) continue;
            const double weight = std::pow((1 - u * u) * focal_ / scale_, 2);
            A += weight * r->jacobian.transpose() * r->jacobian;
            b -= weight * r->jacobian.transpose() * r->error;
        }
        const Vector6 change = A.ldlt().solve(b);
        if (!change.allFinite()) return false;
        motion_ += change;
        Vector6 turn = Vector6::Zero();
        turn.head<3>() = motion_.head<3>();
        at_.rotation = exponential(turn).rotation;
        at_.translation = start_ + motion_.tail<3>();
        const double before = scale_;
        measure();
        settled_ = focal_ * change.norm() < kSettled && scale_ > 0.99 * before;
        return true;
    }

private:
    std::span<const RayMatch> matches_;
    double focal_, unit_;
    bool usable_, settled_ = false;
    Matrix6 information_;
    Eigen::Vector3d start_;
    Estimate at_;
    Vector6 motion_ = Vector6::Zero();
    std::vector<std::optional<Residual>> residuals_;
    std::vector<double> errors_;
    double scale_ = kNotExplained;
};

}  // namespace

PoseRefinement refineRelativePose(std::span<const RayMatch> matches, const PosePrior& prior,
                                  double focal) {
    PoseRefinement out;
    out.patches = static_cast<int>(matches.size());
    Solver solver(matches, prior, focal);
    if (!solver.usable()) return out;
    solver.measure();
    out.normalBefore = out.normalAfter = solver.median();
    for (int i = 0; i < kMostSolves && !solver.settled(); ++i)
        if (!solver.step()) return out;
    out.inliers = solver.inliers();
    const double after = solver.median();
    const double gained = out.normalBefore * out.normalBefore - after * after;
    out.accepted = out.inliers >= kFewest && out.inliers >= kFewestShare * out.patches &&
                   gained > kExactEnough * kExactEnough;
    if (!out.accepted) return out;
    out.normalAfter = after;
    out.motion = solver.motion();
    return out;
}

Eigen::Matrix2d spreadOf(const RayMatch& match, const PosePrior& prior) {
    const Eigen::Vector2d& seen = match.still;
    const Eigen::Vector2d way = prior.translation.head<2>() - seen * prior.translation.z();
    const double square = way.squaredNorm();
    const double inverseDepth = square > 0 ? (seen - match.video).dot(way) / square : 0;
    const Matrix23 byPoint = rayOfPoint(seen, 1);
    Matrix26 J;
    J << -byPoint * skew(seen.homogeneous()), inverseDepth * byPoint;
    return J * prior.covariance * J.transpose();
}

}  // namespace mfar
