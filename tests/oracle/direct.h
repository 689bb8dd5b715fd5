#pragma once

#include "pipeline/engine/cells.h"
#include "pipeline/engine/params/flow.h"
#include "pipeline/engine/params/weigh.h"
#include "tests/oracle/luma.h"
#include "tests/oracle/patch.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

/// Oracle of the comparison of doubtful cells with the still itself, see params::kPatchSamples.
namespace mfar::twin {

struct DirectCase {
    StereoRig rig;
    Grey video, still;
    Size cells;
    std::vector<Eigen::Vector2d> lines;  ///< flow along epipolar lines, one vector per cell
    double noise = 0;                    ///< standard deviation [grey levels]

    [[nodiscard]] bool has(int x, int y) const {
        return x >= 0 && y >= 0 && x < cells.width && y < cells.height;
    }
    [[nodiscard]] Eigen::Vector2d line(int x, int y) const {
        x = std::clamp(x, 0, cells.width - 1);
        y = std::clamp(y, 0, cells.height - 1);
        return lines[static_cast<std::size_t>(y) * cells.width + x];
    }
};

/// Returns the flow along epipolar lines, smoothed around a cell as params::kPairReach describes.
inline Eigen::Vector2d smoothLine(const DirectCase& in, int x, int y) {
    Eigen::Vector2d middle;
    for (int axis = 0; axis < 2; ++axis) {
        std::vector<double> nine;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                nine.push_back(in.line(x + i, y + j)[axis]);
        std::ranges::sort(nine);
        middle[axis] = nine[4];
    }
    // The loop visits each pair of opposite neighbours twice. The weighted mean stays the same,
    // because the middle counts twice too.
    Eigen::Vector2d sum = 2 * middle;
    double weight = 2;
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
            if ((i == 0 && j == 0) || !in.has(x + i, y + j) || !in.has(x - i, y - j)) continue;
            const Eigen::Vector2d mean = (in.line(x + i, y + j) + in.line(x - i, y - j)) / 2;
            const double near =
                std::max(1 - (mean - middle).squaredNorm() / std::pow(params::kPairReach, 2), 0.0);
            sum += near * mean;
            weight += near;
        }
    return sum / weight;
}

/// Change of the flow per pixel along one axis, at most kSteepestFlow: the smaller one-sided
/// difference, or 0 if the signs differ. The neighbours are 2 cells (8 px) away along this axis:
/// (`i`, `j`) is (2, 0) or (0, 2).
inline Eigen::Vector2d lineSlope(const DirectCase& in, int x, int y, int i, int j) {
    // A cell at the border has the change of the nearest cell that has both neighbours.
    x = std::max(std::min(x, in.cells.width - 1 - i), i);
    y = std::max(std::min(y, in.cells.height - 1 - j), j);
    const Eigen::Vector2d before = in.line(x, y) - in.line(x - i, y - j),
                          after = in.line(x + i, y + j) - in.line(x, y);
    Eigen::Vector2d out = Eigen::Vector2d::Zero();
    for (int axis = 0; axis < 2; ++axis)
        if (before[axis] * after[axis] > 0)
            out[axis] =
                std::clamp(std::copysign(std::min(std::abs(before[axis]), std::abs(after[axis])),
                                         after[axis]) /
                               8,
                           -double{params::kSteepestFlow}, double{params::kSteepestFlow});
    return out;
}

/// Compares the patch of a cell with the still. Returns covariance, variance of the video and
/// variance of the still, each summed over the patch, and the squared correlation. Returns zeros if
/// the patch's centre is outside the still.
inline Eigen::Vector4d directLikeness(const DirectCase& in, int x, int y,
                                      const Eigen::Vector2d& flow) {
    const Eigen::Vector2d middle(4 * x + 1.5, 4 * y + 1.5);
    const Eigen::Vector2d slopeX = lineSlope(in, x, y, 2, 0), slopeY = lineSlope(in, x, y, 0, 2);
    Eigen::Matrix<double, 64, 1> video, still;
    const Eigen::Vector2d shift(patchStart(x, in.video.size.width) + 3.5 - middle.x(),
                                patchStart(y, in.video.size.height) + 3.5 - middle.y());
    const Eigen::Vector2d centre =
        stillPixel(in.rig, middle + shift + flow + shift.x() * slopeX + shift.y() * slopeY);
    if (!(centre.minCoeff() >= 0 && centre.x() <= in.rig.still.size.width - 1 &&
          centre.y() <= in.rig.still.size.height - 1))
        return Eigen::Vector4d::Zero();
    for (int k = 0; k < 64; ++k) {
        const int px = patchStart(x, in.video.size.width) + k % 8;
        const int py = patchStart(y, in.video.size.height) + k / 8;
        video[k] = in.video.at(std::min(px, in.video.size.width - 1),
                               std::min(py, in.video.size.height - 1));
        still[k] = 0;
        for (const double dy : {-0.25, 0.25})
            for (const double dx : {-0.25, 0.25}) {
                const Eigen::Vector2d off(px + dx - middle.x(), py + dy - middle.y());
                const Eigen::Vector2d at =
                    stillPixel(in.rig, middle + flow + off + off.x() * slopeX + off.y() * slopeY);
                still[k] += in.still.bilinear(std::clamp(at.x(), 0.0, in.still.size.width - 1.0),
                                              std::clamp(at.y(), 0.0, in.still.size.height - 1.0)) /
                            4;
            }
    }
    video.array() -= video.mean();
    still.array() -= still.mean();
    const double covariance = video.dot(still);
    const double noise =
        params::kPatchPixels * (in.noise * in.noise + double{params::kByteVariance});
    return {covariance, video.squaredNorm(), still.squaredNorm(),
            std::pow(std::max(covariance, 0.0), 2) /
                ((video.squaredNorm() + noise) * (still.squaredNorm() + noise))};
}

struct DirectResult {
    Eigen::Vector2d flow;
    Eigen::Vector4d likeness;
    double error;
    bool compared;  ///< true: `likeness` replaces the cell's statistics
    /// If the difference of the two candidates' squared correlations changed by more than this, the
    /// other candidate could be chosen (see params::kClearlyAlike). 1 if the candidates are equal
    /// or the cell is not doubtful (see params::kGoodCost).
    double choiceMargin;
};

inline DirectResult matchDirectly(const DirectCase& in, int x, int y, const FlowCell& flow,
                                  double error) {
    const Eigen::Vector2d given(flow.x, flow.y);
    const double least = params::kTexturePerVariance * (1 + in.noise * in.noise);
    if (!(error < params::kNotShown && flow.texture > least &&
          (flow.cost > params::kGoodCost || error > 0)))
        return {given, Eigen::Vector4d::Zero(), error, false, 1};
    const Eigen::Vector2d line = smoothLine(in, x, y);
    const Eigen::Vector4d a = directLikeness(in, x, y, given), b = directLikeness(in, x, y, line);
    const bool differs = (line - given).norm() > params::kSameFlow;
    const double gain = b[3] - a[3] - params::kClearlyAlike;
    const bool moves = differs && gain > 0;
    DirectResult out{moves ? line : given, moves ? b : a, error, false,
                     differs ? std::abs(gain) : 1};
    const double known = std::max(1.0 - flow.cost, 0.0);
    out.compared = out.likeness[3] > known * known;
    if (!out.compared) return out;
    const double cost = 1 - std::sqrt(out.likeness[3]);
    out.error = std::min(error, std::max(cost - params::kGoodCost, 0.0) * params::kErrorPerCost);
    return out;
}

}  // namespace mfar::twin
