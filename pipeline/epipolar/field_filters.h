#pragma once

#include "base/image_view.h"
#include "base/workers.h"

#include <vector>

namespace mfar {

/// Median over 3x3 values; the border repeats. `in` and `out` differ and have size's pixels.
/// Each median is multiplied by `scale`.
void median3x3(const std::vector<float>& in, Size size, Workers& workers, std::vector<float>& out,
               float scale = 1);

/// Least and greatest value within `radius` columns and rows of each pixel.
struct LocalRange {
    std::vector<float> low, high;
    std::vector<float> lowAlong, highAlong;  ///< scratch: along rows alone
};
void localRange(const std::vector<float>& in, Size size, int radius, LocalRange& out);

}  // namespace mfar
