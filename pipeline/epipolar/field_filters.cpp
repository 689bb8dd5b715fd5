#include "pipeline/epipolar/field_filters.h"

#include "pipeline/simd/field_rows.h"

#include <algorithm>
#include <cstddef>

namespace mfar {

void median3x3(const std::vector<float>& in, Size size, Workers& workers, std::vector<float>& out,
               float scale) {
    const int width = size.width, height = size.height;
    workers.forRange(height, 16, [&](int first, int last) {
        const auto row = [&](int y) {
            return in.data() + static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * width;
        };
        for (int y = first; y < last; ++y)
            simd::medianRow(row(y - 1), row(y), row(y + 1), width, scale,
                            out.data() + static_cast<std::size_t>(y) * width);
    });
}

void localRange(const std::vector<float>& in, Size size, int radius, LocalRange& out) {
    const int width = size.width, height = size.height;
    for (auto* field : {&out.low, &out.high, &out.lowAlong, &out.highAlong})
        field->resize(in.size());
    const auto at = [&](int y) { return static_cast<std::size_t>(y) * width; };
    for (int y = 0; y < height; ++y)
        simd::rangeAlongRow(in.data() + at(y), nullptr, width, radius, out.lowAlong.data() + at(y),
                            out.highAlong.data() + at(y));
    for (int y = 0; y < height; ++y) {
        const int first = std::max(y - radius, 0), last = std::min(y + radius + 1, height);
        simd::rangeAcrossRows(out.lowAlong.data() + at(first), out.highAlong.data() + at(first),
                              width, last - first, width, out.low.data() + at(y),
                              out.high.data() + at(y));
    }
}

}  // namespace mfar
