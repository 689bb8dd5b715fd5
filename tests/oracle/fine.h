#pragma once

#include "pipeline/engine/params/weigh.h"
#include "pipeline/enlarge/filter_bank.h"
#include "tests/oracle/enlarge.h"
#include "tests/oracle/superres.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

/// Oracle of the comparison of the video's finest detail with the finest detail of a still.
namespace mfar::twin {

struct FineCase {
    Grey video;
    /// Value of the still at the position to which the flow leads from video pixel (x, y).
    std::function<double(double x, double y)> still;
    std::function<bool(int x, int y)> isMatched;  ///< true if cell (x, y) is matched
    /// Second difference of the flow at a cell [px]. 0 where the flow is not bent.
    std::function<double(int x, int y)> kink;
    /// Variance of the video around a cell [grey levels^2].
    std::function<double(int x, int y)> variance;
};

/// Returns variance of the video, covariance of video and still, and variance of the still. They
/// are computed from differences of pixels in the two middle rows of a cell: to the right neighbour
/// in both rows, and from the upper to the lower row.
inline Eigen::Vector3d fineSums(const FineCase& in, int cellX, int cellY) {
    const Size size = in.video.size;
    if (!in.isMatched(cellX, cellY) || 4 * cellX + 4 > size.width || 4 * cellY + 4 > size.height)
        return Eigen::Vector3d::Zero();
    const auto at = [&in, size](int x, int y) {
        x = std::min(x, size.width - 1);
        const double still = in.still(x - 0.25, y - 0.25) + in.still(x + 0.25, y - 0.25) +
                             in.still(x - 0.25, y + 0.25) + in.still(x + 0.25, y + 0.25);
        return Eigen::Vector2d(in.video.at(x, y), still / 4);
    };
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    const auto add = [&out](const Eigen::Vector2d& d) {
        out += Eigen::Vector3d(d[0] * d[0], d[0] * d[1], d[1] * d[1]) / 24;
    };
    const int upper = 4 * cellY + 1, lower = upper + 1;
    for (int x = 4 * cellX; x < 4 * cellX + 4; ++x) {
        for (const int y : {upper, lower})
            add(at(x + 1, y) - at(x, y));
        add(at(x, lower) - at(x, upper));
    }
    return out;
}

/// Returns for each cell, row by row, the share of its weight that remains after the comparison.
inline std::vector<double> fineShares(const FineCase& in, Size cells, const FineMatch& match) {
    std::vector<Eigen::Vector3d> sums;
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x)
            sums.push_back(fineSums(in, x, y));
    std::vector<double> out;
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x) {
            Eigen::Vector3d mean = Eigen::Vector3d::Zero();
            for (int i = x - 1; i <= x + 1; ++i)
                for (int j = y - 1; j <= y + 1; ++j)
                    mean += (i == x ? 2 : 1) * (j == y ? 2 : 1) / 16.0 *
                            sums[std::clamp(j, 0, cells.height - 1) * cells.width +
                                 std::clamp(i, 0, cells.width - 1)];
            const double both = std::max(mean[1], 0.0), least = params::kFineLeast,
                         noise = match.noise;
            const double unexplained = mean[0] - both * both / (mean[2] + least);
            const double allowed =
                params::kFineRoom * noise + params::kFineShareRoom * double(match.share) * mean[0];
            const double rough = smoothstep(params::kFineTexture, params::kRoughTexture,
                                            mean[0] / (in.variance(x, y) + least));
            const double smooth =
                std::lerp(std::min(allowed / std::max(unexplained, least), 1.0), 1.0, rough);
            const double wrong = std::max(unexplained - params::kFineNoise * noise, 0.0);
            const double alias =
                rough * (1 - smoothstep(params::kAliasedStill, params::kDetailedStill,
                                        (mean[2] + least) / (mean[0] + least)));
            const double kink = in.kink(x, y);
            const double kinked =
                std::lerp(smoothstep(params::kFlatKink, params::kSharpKink, kink),
                          smoothstep(params::kFlatRoughKink, params::kSharpRoughKink, kink), alias);
            out.push_back(std::lerp(smooth, std::pow(1 - wrong / (mean[0] + least), 4), kinked));
        }
    return out;
}

}  // namespace mfar::twin
