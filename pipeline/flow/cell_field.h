#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/flow.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar {

inline constexpr int kCell = 4;          ///< width and height of a cell [video px]
inline constexpr int kCellsPerTile = 4;  ///< along each axis

[[nodiscard]] constexpr int divideUp(int a, int b) {
    return (a + b - 1) / b;
}

[[nodiscard]] constexpr Size cellsOf(Size picture) {
    return {divideUp(picture.width, kCell), divideUp(picture.height, kCell)};
}

inline constexpr int kPatchSide = 8;

/// Returns the first column (or row) of a cell's patch, in a picture with `pixels` columns (or
/// rows). A patch that would extend beyond the picture is moved inside: the still shows what
/// lies beyond, so repeated border pixels of the video would not match it. GLSL: patch_start.glsl.
[[nodiscard]] constexpr int patchStart(int cell, int pixels) {
    return std::max(std::min(kCell * cell - (kPatchSide - kCell) / 2, pixels - kPatchSide), 0);
}

/// Returns how far patchStart() moves a patch from the place around the middle of its cell.
[[nodiscard]] constexpr int patchShift(int cell, int pixels) {
    return patchStart(cell, pixels) - (kCell * cell - (kPatchSide - kCell) / 2);
}

/// Returns the change of the flow per pixel. `before` and `after` are the flow two cells before and
/// after the cell. The result is the one-sided difference that is smaller in magnitude, clamped to
/// +-params::kSteepestFlow. It is 0 if the differences have different signs or if one is NaN. GLSL:
/// slopeAt() in flow_cells.glsl.
[[nodiscard]] inline float slopeOf(float before, float here, float after) {
    const float a = here - before, b = after - here;
    if (!(a * b > 0)) return 0;
    const float least = std::copysign(std::min(std::abs(a), std::abs(b)), b) / (2 * kCell);
    return std::clamp(least, -params::kSteepestFlow, params::kSteepestFlow);
}

/// Interpolates one channel of `cells` bilinearly at pixel (x, y). There are four channels per
/// cell. Beyond the centres of the outermost cells, returns the value of the nearest cell.
[[nodiscard]] inline float sampleCells(const std::vector<float>& cells, Size count, int channel,
                                       double x, double y) {
    const double gx = std::clamp((x + 0.5) / 4 - 0.5, 0.0, count.width - 1.0);
    const double gy = std::clamp((y + 0.5) / 4 - 0.5, 0.0, count.height - 1.0);
    const int x0 = static_cast<int>(gx), y0 = static_cast<int>(gy);
    const int x1 = std::min(x0 + 1, count.width - 1), y1 = std::min(y0 + 1, count.height - 1);
    const double fx = gx - x0, fy = gy - y0;
    const auto at = [&](int cx, int cy) {
        return static_cast<double>(cells[4UL * (1UL * cy * count.width + cx) + channel]);
    };
    return static_cast<float>(std::lerp(std::lerp(at(x0, y0), at(x1, y0), fx),
                                        std::lerp(at(x0, y1), at(x1, y1), fx), fy));
}

}  // namespace mfar
