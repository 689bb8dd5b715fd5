#pragma once

#include "base/image_view.h"
#include "base/workers.h"

#include <vector>

namespace mfar {

/// Writes the 3x3 median of `in`, multiplied by `scale`, to `out`. Pixels outside the picture
/// repeat its border. `in` and `out` must be different vectors of `size` pixels.
void median3x3(const std::vector<float>& in, Size size, Workers& workers, std::vector<float>& out,
               float scale = 1);

/// Smallest and largest value in the square within `radius` pixels of each pixel.
struct LocalRange {
    std::vector<float> low, high;
    std::vector<float> lowAlong, highAlong;
};
void localRange(const std::vector<float>& in, Size size, int radius, LocalRange& out);

}  // namespace mfar
