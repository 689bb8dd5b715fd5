#pragma once

#include "pipeline/engine/params/weigh.h"
#include "pipeline/enlarge/filter_bank.h"
#include "tests/oracle/upscale.h"

#include <Eigen/Dense>

#include <algorithm>
#include <functional>
#include <vector>

/// Oracle of the comparison of the video's finest detail with the finest detail of a still.
namespace mfar::twin {

struct FineCase {
    Grey video;
    /// Value of the still at the position to which the flow leads from video pixel (x, y).
    std::function<double(double x, double y)> still;
    std::function<bool(int x, int y)> isMatched;  ///< true if cell (x, y) is matched
};

/// Returns variance of the video, covariance of video and still, and variance of the still. They
/// are computed from the two blocks of 2x2 pixels in the middle two rows of a cell.
inline Eigen::Vector3d fineSums(const FineCase& in, int cellX, int cellY) {
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    const Size size = in.video.size;
    if (!in.isMatched(cellX, cellY) || 4 * cellX + 4 > size.width || 4 * cellY + 4 > size.height)
        return out;
    for (const int first : {4 * cellX, 4 * cellX + 2}) {
        Eigen::Vector4d video, still;
        for (int i = 0; i < 4; ++i) {
            const int x = first + i % 2, y = 4 * cellY + 1 + i / 2;
            video[i] = in.video.at(x, y);
            still[i] = (in.still(x - 0.25, y - 0.25) + in.still(x + 0.25, y - 0.25) +
                        in.still(x - 0.25, y + 0.25) + in.still(x + 0.25, y + 0.25)) /
                       4;
        }
        video.array() -= video.mean();
        still.array() -= still.mean();
        out += Eigen::Vector3d(video.dot(video), video.dot(still), still.dot(still)) / 8;
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
            // Only even rows of cells are sampled. Odd rows use the even rows above and below them.
            const int above = y - y % 2, below = std::min(y + y % 2, (cells.height - 1) / 2 * 2);
            for (int i = x - 1; i <= x + 1; ++i)
                for (const int j : {above, below})
                    mean += (i == x ? 2 : 1) / 8.0 *
                            sums[j * cells.width + std::clamp(i, 0, cells.width - 1)];
            const double both = std::max(mean[1], 0.0);
            const double unexplained = mean[0] - both * both / (mean[2] + params::kFineLeast);
            const double allowed = params::kFineRoom * double(match.noise) +
                                   params::kFineShareRoom * double(match.share) * mean[0];
            out.push_back(
                std::min(allowed / std::max(unexplained, double(params::kFineLeast)), 1.0));
        }
    return out;
}

}  // namespace mfar::twin
