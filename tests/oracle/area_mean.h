#pragma once

#include "hal/device/display_spec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mfar::twin {

/// Mean colour of a picture over the area [lo, hi) in x and y. `colour(x, y)` returns the three
/// channels of a pixel. Positions outside the picture repeat its edge.
template <class Colour>
std::array<double, 3> areaMean(Size size, Colour colour, std::array<double, 2> lo,
                               std::array<double, 2> hi) {
    std::array<double, 3> sum{};
    for (int y = static_cast<int>(std::floor(lo[1])); y < hi[1]; ++y)
        for (int x = static_cast<int>(std::floor(lo[0])); x < hi[0]; ++x) {
            const double w = (std::min(hi[0], x + 1.0) - std::max(lo[0], double(x))) *
                             (std::min(hi[1], y + 1.0) - std::max(lo[1], double(y)));
            const auto c =
                colour(std::clamp(x, 0, size.width - 1), std::clamp(y, 0, size.height - 1));
            for (std::size_t k = 0; k < 3; ++k)
                sum[k] += w * c[k];
        }
    for (double& s : sum)
        s /= (hi[0] - lo[0]) * (hi[1] - lo[1]);
    return sum;
}

/// Oracle of display_scale.frag, which scales a picture of size `size` to the rectangle `to` of the
/// screen. Returns the colour of pixel (x, y) of the rectangle.
template <class Colour>
std::array<double, 3> scaledPixel(Size size, Colour colour, const ScreenRect& to, int x, int y) {
    const double sx = double(size.width) / to.size.width;
    const double sy = double(size.height) / to.size.height;
    const double fx = std::max(sx, 1.0), fy = std::max(sy, 1.0);
    const double cx = (x + 0.5) * sx, cy = (y + 0.5) * sy;
    return areaMean(size, colour, {cx - fx / 2, cy - fy / 2}, {cx + fx / 2, cy + fy / 2});
}

}  // namespace mfar::twin
