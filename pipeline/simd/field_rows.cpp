#include "pipeline/simd/field_rows.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/field_rows.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/depth_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

constexpr float kLargest = hwy::HighestValue<float>();

template <class V>
HWY_INLINE void order(V& a, V& b) {
    const V low = hn::Min(a, b);
    b = hn::Max(a, b);
    a = low;
}

/// Returns the median of nine values, which are three rows of three. Each column of three values is
/// sorted first. The result is the median of three values: the largest of the low values, the
/// median of the middle values, and the smallest of the high values.
template <class V>
HWY_INLINE V middleOfNine(V (&v)[9]) {
    for (int c = 0; c < 3; ++c) {
        order(v[c], v[c + 3]);
        order(v[c + 3], v[c + 6]);
        order(v[c], v[c + 3]);
    }
    order(v[3], v[4]);
    order(v[4], v[5]);
    order(v[3], v[4]);
    V low = hn::Max(hn::Max(v[0], v[1]), v[2]), middle = v[4];
    V high = hn::Min(hn::Min(v[6], v[7]), v[8]);
    order(low, middle);
    order(middle, high);
    return hn::Max(low, middle);
}

void MedianRow(const float* above, const float* here, const float* below, std::size_t width,
               float scale, float* out) {
    const float* const rows[3] = {above, here, below};
    const auto at = [&](auto d, std::size_t left, std::size_t x, std::size_t right) HWY_ATTR {
        hn::Vec<decltype(d)> v[9];
        for (int j = 0; j < 3; ++j) {
            v[3 * j] = hn::LoadU(d, rows[j] + left);
            v[3 * j + 1] = hn::LoadU(d, rows[j] + x);
            v[3 * j + 2] = hn::LoadU(d, rows[j] + right);
        }
        hn::StoreU(hn::Mul(middleOfNine(v), hn::Set(d, scale)), d, out + x);
    };
    const hn::CappedTag<float, 1> one;
    at(one, 0, 0, std::min<std::size_t>(1, width - 1));
    if (width > 2)
        forLanes(hn::ScalableTag<float>(), width - 2,
                 [&](auto d, std::size_t x) HWY_ATTR { at(d, x, x + 1, x + 2); });
    if (width > 1) at(one, width - 2, width - 1, width - 1);
}

void RangeAlongRow(const float* values, const float* variance, std::size_t width, int radius,
                   float* low, float* high) {
    // The row is processed in pieces of kRun columns. `lows` and `highs` contain the values of a
    // piece, with `radius` more values on both sides. Beyond the ends of the row, `lows` contains
    // kLargest and `highs` -kLargest, so these entries have no effect.
    constexpr std::size_t kRun = 256, kAll = kRun + 2 * kMostRange;
    HWY_ALIGN float lows[kAll], highs[kAll];
    const auto beside = static_cast<std::size_t>(radius);
    for (std::size_t begin = 0; begin < width; begin += kRun) {
        const std::size_t count = std::min(kRun, width - begin);
        const std::size_t first = begin - std::min(begin, beside);
        const std::size_t last = std::min(begin + count + beside, width);
        const std::size_t at = first + beside - begin;
        std::fill_n(lows, count + 2 * beside, kLargest);
        std::fill_n(highs, count + 2 * beside, -kLargest);
        forLanes(hn::ScalableTag<float>(), last - first, [&](auto d, std::size_t i) HWY_ATTR {
            const auto v = hn::LoadU(d, values + first + i);
            auto least = v, most = v;
            if (variance != nullptr) {
                const auto sound = isSound(d, v, hn::LoadU(d, variance + first + i));
                least = hn::IfThenElse(sound, v, hn::Set(d, kLargest));
                most = hn::IfThenElse(sound, v, hn::Set(d, -kLargest));
            }
            hn::StoreU(least, d, lows + at + i);
            hn::StoreU(most, d, highs + at + i);
        });
        forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
            auto least = hn::LoadU(d, lows + i), most = hn::LoadU(d, highs + i);
            for (std::size_t k = 1; k <= 2 * beside; ++k) {
                least = hn::Min(least, hn::LoadU(d, lows + i + k));
                most = hn::Max(most, hn::LoadU(d, highs + i + k));
            }
            hn::StoreU(least, d, low + begin + i);
            hn::StoreU(most, d, high + begin + i);
        });
    }
}

void RangeAcrossRows(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
                     std::size_t width, float* outLow, float* outHigh) {
    forLanes(hn::ScalableTag<float>(), width, [&](auto d, std::size_t x) HWY_ATTR {
        const auto range = rangeOver(d, low + x, high + x, pitch, rows);
        hn::StoreU(range.low, d, outLow + x);
        hn::StoreU(range.high, d, outHigh + x);
    });
}

float GreatestOf(const float* values, std::size_t count) {
    const hn::ScalableTag<float> d;
    auto most = hn::Zero(d);
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d))
        most = hn::Max(most, hn::LoadU(d, values + i));
    float out = hn::GetLane(hn::MaxOfLanes(d, most));
    for (; i < count; ++i)
        out = std::max(out, values[i]);
    return out;
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(MedianRow);
HWY_EXPORT(RangeAlongRow);
HWY_EXPORT(RangeAcrossRows);
HWY_EXPORT(GreatestOf);

void medianRow(const float* above, const float* here, const float* below, std::size_t width,
               float scale, float* out) {
    HWY_DYNAMIC_DISPATCH(MedianRow)(above, here, below, width, scale, out);
}

void rangeAlongRow(const float* values, const float* variance, std::size_t width, int radius,
                   float* low, float* high) {
    HWY_DYNAMIC_DISPATCH(RangeAlongRow)(values, variance, width, radius, low, high);
}

void rangeAcrossRows(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
                     std::size_t width, float* outLow, float* outHigh) {
    HWY_DYNAMIC_DISPATCH(RangeAcrossRows)(low, high, pitch, rows, width, outLow, outHigh);
}

float greatestOf(const float* values, std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(GreatestOf)(values, count);
}

}  // namespace mfar::simd
#endif
