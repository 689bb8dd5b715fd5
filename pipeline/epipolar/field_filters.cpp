#include "pipeline/epipolar/field_filters.h"

#include <algorithm>
#include <cstddef>

namespace mfar {
namespace {

inline void order(float& a, float& b) {
    const float low = std::min(a, b);
    b = std::max(a, b);
    a = low;
}

/// Middle of nine: sorts three columns, then takes the middle of (greatest low, middle of middles,
/// least high).
inline float middleOfNine(float (&v)[9]) {
    for (int c = 0; c < 3; ++c) {
        order(v[c], v[c + 3]);
        order(v[c + 3], v[c + 6]);
        order(v[c], v[c + 3]);
    }
    order(v[3], v[4]);
    order(v[4], v[5]);
    order(v[3], v[4]);
    float low = std::max(std::max(v[0], v[1]), v[2]), middle = v[4];
    float high = std::min(std::min(v[6], v[7]), v[8]);
    order(low, middle);
    order(middle, high);
    order(low, middle);
    return middle;
}

}  // namespace

void median3x3(const std::vector<float>& in, Size size, Workers& workers, std::vector<float>& out) {
    const int w = size.width, h = size.height;
    workers.forRange(h, 16, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            const float* rows[3];
            for (int j = 0; j < 3; ++j)
                rows[j] = in.data() + static_cast<std::size_t>(std::clamp(y + j - 1, 0, h - 1)) * w;
            float* to = out.data() + static_cast<std::size_t>(y) * w;
            const auto at = [&](int left, int x, int right) {
                float v[9] = {rows[0][left], rows[0][x], rows[0][right],
                              rows[1][left], rows[1][x], rows[1][right],
                              rows[2][left], rows[2][x], rows[2][right]};
                return middleOfNine(v);
            };
            to[0] = at(0, 0, std::min(1, w - 1));
            for (int x = 1; x + 1 < w; ++x)
                to[x] = at(x - 1, x, x + 1);
            if (w > 1) to[w - 1] = at(w - 2, w - 1, w - 1);
        }
    });
}

void localRange(const std::vector<float>& in, Size size, int radius, LocalRange& out) {
    const int w = size.width, h = size.height;
    std::vector<float> low(in.size()), high(in.size());
    for (int y = 0; y < h; ++y) {
        const float* from = in.data() + static_cast<std::size_t>(y) * w;
        for (int x = 0; x < w; ++x) {
            const auto [a, b] = std::minmax_element(from + std::max(x - radius, 0),
                                                    from + std::min(x + radius + 1, w));
            low[static_cast<std::size_t>(y) * w + x] = *a;
            high[static_cast<std::size_t>(y) * w + x] = *b;
        }
    }
    out.low.resize(in.size());
    out.high.resize(in.size());
    for (int y = 0; y < h; ++y) {
        const std::size_t to = static_cast<std::size_t>(y) * w;
        std::copy_n(low.begin() + static_cast<std::ptrdiff_t>(to), w,
                    out.low.begin() + static_cast<std::ptrdiff_t>(to));
        std::copy_n(high.begin() + static_cast<std::ptrdiff_t>(to), w,
                    out.high.begin() + static_cast<std::ptrdiff_t>(to));
        for (int j = std::max(y - radius, 0); j <= std::min(y + radius, h - 1); ++j) {
            const std::size_t from = static_cast<std::size_t>(j) * w;
            for (int x = 0; x < w; ++x) {
                out.low[to + x] = std::min(out.low[to + x], low[from + x]);
                out.high[to + x] = std::max(out.high[to + x], high[from + x]);
            }
        }
    }
}

}  // namespace mfar
