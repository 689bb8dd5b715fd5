#include "daemon/tools/calibrate/camera_fit.h"
#include "daemon/tools/calibrate/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mfar::calibration {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// The views must have at least this tilt and this range of depths. With less, many pairs of focal
// length and target distance would fit equally well.
constexpr double kLeastTilt = 12 * kDegree;
constexpr double kLeastDepth = 1.2;  // distance of the farthest / distance of the nearest corner
constexpr double kLeastCoverage = 0.6;
// Quantiles are used instead of the largest and smallest values, so that no single view decides.
// The largest tilt and the largest depth are replaced by the quantile kMostlyAt. The smallest depth
// is replaced by the quantile 1 - kMostlyAt.
constexpr double kMostlyAt = 0.9;

double quantile(std::vector<double> values, double q) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

struct Spread {
    double tilt = 0;
    double depth = 1;
};

Spread spreadOf(const Target& target, const std::vector<TargetView>& views,
                const CameraModel& camera) {
    std::vector<Eigen::Vector3d> normals;
    std::vector<double> depths;
    for (const TargetView& view : views) {
        const auto T = targetPose(target, view, camera);
        if (!T) continue;
        normals.emplace_back(T->rotation * Eigen::Vector3d::UnitZ());
        for (const Corner& c : view.corners)
            depths.push_back((*T * target.points[c.index]).z());
    }
    Spread out;
    if (normals.empty()) return out;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& n : normals)
        mean += n;
    std::vector<double> angles;
    for (const Eigen::Vector3d& n : normals)
        angles.push_back(std::acos(std::clamp(n.dot(mean.normalized()), -1., 1.)));
    out.tilt = quantile(angles, kMostlyAt);
    out.depth = quantile(depths, kMostlyAt) / quantile(depths, 1 - kMostlyAt);
    return out;
}

}  // namespace

void checkViews(const Target& target, const std::vector<TargetView>& views,
                const CameraModel& guess, const std::string& sensor, int leastViews) {
    const int count = static_cast<int>(views.size());
    if (count < leastViews)
        throw Unsuitable(fmt::format(
            "too few views: {} pictures of the {} sensor show the target; at least {} are needed",
            count, sensor, leastViews));
    const Spread spread = spreadOf(target, views, guess);
    if (!(spread.tilt >= kLeastTilt))
        throw Unsuitable(fmt::format(
            "the {} sensor saw the target from nearly one direction (the target was tilted by "
            "{:.0f} degrees; at least {:.0f} are needed): tilt the target to all sides",
            sensor, spread.tilt / kDegree, kLeastTilt / kDegree));
    if (!(spread.depth >= kLeastDepth))
        throw Unsuitable(fmt::format(
            "the {} sensor saw the target at nearly one distance (its farthest corner was "
            "{:.2f} times as far away as its nearest; at least {:.2f} times are needed): "
            "show it closer and farther away",
            sensor, spread.depth, kLeastDepth));
    Coverage coverage(guess.size);
    for (const TargetView& view : views)
        coverage.add(view.corners);
    if (!(coverage.share() >= kLeastCoverage))
        throw Unsuitable(
            fmt::format("the target covered only {:.0f} % of the {} sensor's picture; at "
                        "least {:.0f} % are needed: show it at {}",
                        100 * coverage.share(), sensor, 100 * kLeastCoverage, coverage.emptiest()));
}

}  // namespace mfar::calibration
