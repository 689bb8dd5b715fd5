#pragma once

#include "base/image_view.h"
#include "base/workers.h"

#include <vector>

namespace mfar {

/// Computes the 3x3 median of `in` and writes it, multiplied by `scale`, to `out`. Pixels outside
/// the picture repeat its border. `in` and `out` must be different vectors of `size` pixels.
void median3x3(const std::vector<float>& in, Size size, Workers& workers, std::vector<float>& out,
               float scale = 1);

/// The smallest and the largest value around each pixel, in the square of pixels that are at most
/// `radius` away along each axis.
struct LocalRange {
    std::vector<float> low, high;
    std::vector<float> lowAlong, highAlong;
};
void localRange(const std::vector<float>& in, Size size, int radius, LocalRange& out);

}  // namespace mfar
