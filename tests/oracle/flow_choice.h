#pragma once

#include "tests/oracle/subpixel.h"

/// Oracle of the choice of the flow at depth edges, see params::kOtherSurface.
namespace mfar::twin {

/// Returns the sum of the squared differences between the cell's 16 pixels and the still at `flow`.
inline double choiceError(const SubpixelCase& in, int x, int y, const Eigen::Vector2d& flow) {
    const Eigen::Vector2d at = centreInStill(in, x, y, flow);
    Eigen::Matrix2d along;  // change of the position in the still per video pixel
    along << (centreInStill(in, x + 1, y, flow) - at) / 4,
        (centreInStill(in, x, y + 1, flow) - at) / 4;
    double error = 0;
    for (int k = 0; k < 16; ++k) {
        const int column = k % 4, row = k / 4;
        const Eigen::Array2d means = seenAt(in, at, along, column - 1.5, row - 1.5);
        const double seen = std::lerp(means[0], std::sqrt(means[1]), in.light);
        error += std::pow(in.video.at(4 * x + column, 4 * y + row) - seen, 2);
    }
    return error;
}

/// Amount that is added to both errors of a cell before they are compared.
inline double choiceNoise(const SubpixelCase& in) {
    return 16 * (in.noise * in.noise + double{params::kChoiceVariance});
}

/// Returns the neighbours, as indices, whose flow the cell compares with its own.
inline std::vector<std::size_t> flowSteps(const SubpixelCase& in, int x, int y) {
    std::vector<std::size_t> out;
    if (!in.compared[in.index(x, y)]) return out;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            if (!in.has(x + i, y + j)) continue;
            const std::size_t n = in.index(x + i, y + j);
            const double step = (in.flow[n] - in.flow[in.index(x, y)]).norm();
            if (in.compared[n] && step > params::kOtherSurface) out.push_back(n);
        }
    return out;
}

}  // namespace mfar::twin
