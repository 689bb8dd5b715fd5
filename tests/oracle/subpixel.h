#pragma once

#include "pipeline/engine/params/flow.h"
#include "pipeline/engine/params/weigh.h"
#include "tests/oracle/luma.h"
#include "tests/oracle/patch.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

/// Oracle of the correction of the flow by a fraction of a pixel, see params::kSubpixelReach.
namespace mfar::twin {

struct SubpixelCase {
    StereoRig rig;
    Grey video, still;
    Size cells;
    std::vector<Eigen::Vector2d> flow;  ///< one vector per cell
    std::vector<bool> compared;         ///< cells that are compared with the still
    double noise = 0;                   ///< standard deviation [grey levels]
    double light = 0;                   ///< see Guidance::light

    [[nodiscard]] bool has(int x, int y) const {
        return x >= 0 && y >= 0 && x < cells.width && y < cells.height;
    }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(std::clamp(y, 0, cells.height - 1)) * cells.width +
               std::clamp(x, 0, cells.width - 1);
    }
};

/// Returns the position in the still of the cell's centre.
inline Eigen::Vector2d centreInStill(const SubpixelCase& in, int x, int y,
                                     const Eigen::Vector2d& flow) {
    return stillPixel(in.rig, Eigen::Vector2d(4 * x + 1.5, 4 * y + 1.5) + flow);
}

/// Returns true if the still shows the cell's centre.
inline bool isShown(const SubpixelCase& in, int x, int y, const Eigen::Vector2d& flow) {
    const Eigen::Vector2d at = centreInStill(in, x, y, flow);
    return at.minCoeff() >= 0 && at.x() <= in.rig.still.size.width - 1 &&
           at.y() <= in.rig.still.size.height - 1;
}

/// Returns the mean of the still over a video pixel, and the mean of its squares. (right, down):
/// distance of the pixel from the cell's centre. `at`: position of this centre in the still.
/// `along`: change of the position in the still per video pixel.
inline Eigen::Array2d seenAt(const SubpixelCase& in, const Eigen::Vector2d& at,
                             const Eigen::Matrix2d& along, double right, double down) {
    Eigen::Array2d sum(0, 0);
    for (const double dy : {-0.25, 0.25})
        for (const double dx : {-0.25, 0.25}) {
            const Eigen::Vector2d p = at + along * Eigen::Vector2d(right + dx, down + dy);
            const double value =
                in.still.bilinear(std::clamp(p.x(), 0.0, in.still.size.width - 1.0),
                                  std::clamp(p.y(), 0.0, in.still.size.height - 1.0));
            sum += Eigen::Array2d(value, value * value);
        }
    return sum / 4;
}

/// Columns: change of the flow per pixel along x and along y.
inline Eigen::Matrix2d slopesOf(const SubpixelCase& in, int x, int y) {
    Eigen::Matrix2d out;
    for (int column = 0; column < 2; ++column) {
        const int i = column == 0 ? 2 : 0, j = 2 - i;
        // A cell at the border has the change of the nearest cell that has both neighbours.
        const int c = std::max(std::min(x, in.cells.width - 1 - i), i);
        const int r = std::max(std::min(y, in.cells.height - 1 - j), j);
        const Eigen::Vector2d here = in.flow[in.index(c, r)];
        const Eigen::Vector2d before = here - in.flow[in.index(c - i, r - j)],
                              after = in.flow[in.index(c + i, r + j)] - here;
        for (int axis = 0; axis < 2; ++axis) {
            const double least = std::min(std::abs(before[axis]), std::abs(after[axis])) / 8;
            const double most = params::kSteepestFlow;
            out(axis, column) = before[axis] * after[axis] > 0
                                    ? std::copysign(std::min(least, most), after[axis])
                                    : 0;
        }
    }
    return out;
}

/// Products of the deviations from the mean, summed over the cell's pixels. Rows and columns: luma
/// of the video, luma of the still, derivatives of the still's luma with respect to the flow.
inline Eigen::Matrix4d scatterOf(const SubpixelCase& in, int x, int y) {
    const Eigen::Matrix2d slopes = slopesOf(in, x, y);
    const Eigen::Vector2d middle(4 * x + 1.5, 4 * y + 1.5), flow = in.flow[in.index(x, y)];
    const auto place = [&](const Eigen::Vector2d& off) {
        return stillPixel(in.rig, middle + flow + off + slopes * off);
    };
    const Eigen::Vector2d at = place({0, 0});
    Eigen::Matrix2d along;  // change of the position in the still per video pixel
    along << (place({4, 0}) - at) / 4, (place({0, 4}) - at) / 4;
    const auto seen = [&](double right, double down) { return seenAt(in, at, along, right, down); };
    Eigen::Matrix<double, 4, 16> all;
    for (int k = 0; k < 16; ++k) {
        const int column = k % 4, row = k / 4;
        const double i = column - 1.5, j = row - 1.5;
        const Eigen::Array2d here = seen(i, j), alongX = seen(i + 0.5, j) - seen(i - 0.5, j),
                             alongY = seen(i, j + 0.5) - seen(i, j - 0.5);
        const double root = std::max(std::sqrt(here[1]), 1.0);
        const auto mixed = [&](double mean, double ofLight) {
            return std::lerp(mean, ofLight, in.light);
        };
        all.col(k) << in.video.at(4 * x + column, 4 * y + row), mixed(here[0], root),
            mixed(alongX[0], alongX[1] / (2 * root)), mixed(alongY[0], alongY[1] / (2 * root));
    }
    all.colwise() -= all.rowwise().mean().eval();
    return all * all.transpose();
}

struct SubpixelStep {
    Eigen::Vector2d step = Eigen::Vector2d::Zero();  ///< taken() may refuse it
    double gain = 0;
    [[nodiscard]] Eigen::Vector2d taken() const {
        const bool takes =
            gain >= params::kLeastSubpixelGain && step.norm() < params::kSubpixelLongest;
        return takes ? step : Eigen::Vector2d::Zero();
    }
};

/// `scatter`: scatterOf() of every cell; zero if the cell is not compared.
inline SubpixelStep stepOf(const SubpixelCase& in, const std::vector<Eigen::Matrix4d>& scatter,
                           int x, int y) {
    const Eigen::Matrix2d slopes = slopesOf(in, x, y);
    Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
    Eigen::Vector2d away = Eigen::Vector2d::Zero();
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            if (!in.has(x + i, y + j)) continue;
            const std::size_t n = in.index(x + i, y + j);
            const Eigen::Vector2d off =
                in.flow[n] - in.flow[in.index(x, y)] - slopes * Eigen::Vector2d(4.0 * i, 4.0 * j);
            const double weight = (2 - std::abs(i)) * (2 - std::abs(j)) *
                                  (1 - std::pow(off.norm() / params::kSubpixelReach, 2));
            if (!(weight > 0)) continue;
            sum += weight * scatter[n];
            away += weight * scatter[n].bottomRightCorner<2, 2>() * off;
        }
    const double pixels = params::kSubpixelPixels;
    const double noise = pixels * (in.noise * in.noise + double{params::kByteVariance});
    SubpixelStep out;
    out.gain = sum(0, 1) / (sum(1, 1) + noise);
    const double unexplained = std::max(sum(0, 0) - out.gain * sum(0, 1), 0.0);
    const double damping =
        (unexplained + noise) / (pixels * std::pow(double{params::kSubpixelError}, 2));
    const Eigen::Matrix2d squares = std::pow(out.gain, 2) * sum.bottomRightCorner<2, 2>() +
                                    damping * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d error =
        out.gain * (sum.block<1, 2>(0, 2) - out.gain * sum.block<1, 2>(1, 2)).transpose() +
        std::pow(out.gain, 2) * away;
    out.step = squares.inverse() * error;
    return out;
}

}  // namespace mfar::twin
