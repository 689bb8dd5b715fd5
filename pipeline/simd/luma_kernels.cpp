#include "pipeline/simd/luma_kernels.h"

#include "pipeline/engine/params/luma.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/luma_kernels.cpp"
#include <algorithm>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// Number of columns that are smoothed at once; their intermediate values stay on the stack.
constexpr int kStrip = 256;
constexpr int kMostLanes = 16;
using Floats = hn::CappedTag<float, kMostLanes>;
using Bytes = hn::Rebind<std::uint8_t, Floats>;
using Vec = hn::Vec<Floats>;

HWY_INLINE Vec loadFloats(const std::uint8_t* from) {
    const Floats d;
    return hn::ConvertTo(d, hn::PromoteTo(hn::RebindToSigned<Floats>(), hn::LoadU(Bytes(), from)));
}

HWY_INLINE hn::Vec<Bytes> roundedBytes(Vec v) {
    const Floats d;
    const auto held =
        hn::Min(hn::Max(hn::Add(v, hn::Set(d, 0.5F)), hn::Zero(d)), hn::Set(d, 255.0F));
    return hn::DemoteTo(Bytes(), hn::ConvertTo(hn::RebindToSigned<Floats>(), held));
}

HWY_INLINE Vec lumaAt(const SmoothRows::Planes& p, int x) {
    const Floats d;
    if (p.green == nullptr) return loadFloats(p.red + x);
    return hn::MulAdd(hn::Set(d, params::kLumaRed), loadFloats(p.red + x),
                      hn::MulAdd(hn::Set(d, params::kLumaGreen), loadFloats(p.green + x),
                                 hn::Mul(hn::Set(d, params::kLumaBlue), loadFloats(p.blue + x))));
}

HWY_INLINE float oneLumaAt(const SmoothRows::Planes& p, int x) {
    if (p.green == nullptr) return p.red[x];
    return params::kLumaRed * p.red[x] + params::kLumaGreen * p.green[x] +
           params::kLumaBlue * p.blue[x];
}

HWY_INLINE void smoothColumns(const SmoothRows& rows, int first, int end, float side, float* to) {
    const Floats d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    const auto sides = hn::Set(d, side), centre = hn::Set(d, 1 - 2 * side);
    int x = first;
    for (; x + lanes <= end; x += lanes) {
        const Vec beside = hn::Add(lumaAt(rows.above, x), lumaAt(rows.below, x));
        hn::StoreU(hn::MulAdd(sides, beside, hn::Mul(centre, lumaAt(rows.here, x))), d,
                   to + x - first);
    }
    for (; x < end; ++x)
        to[x - first] = side * (oneLumaAt(rows.above, x) + oneLumaAt(rows.below, x)) +
                        (1 - 2 * side) * oneLumaAt(rows.here, x);
}

}  // namespace

void SmoothLumaRow(const SmoothRows& rows, int width, float side, std::uint8_t* to) {
    const Floats d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    const auto sides = hn::Set(d, side), centre = hn::Set(d, 1 - 2 * side);
    HWY_ALIGN float columns[kStrip + 2 + kMostLanes];
    std::uint8_t rest[kMostLanes];
    for (int first = 0; first < width; first += kStrip) {
        const int count = std::min(kStrip, width - first);
        const int left = std::max(first - 1, 0), right = std::min(first + count + 1, width);
        smoothColumns(rows, left, right, side, columns + 1 + left - first);
        if (first == 0) columns[0] = columns[1];
        if (first + count == width) columns[count + 1] = columns[count];
        std::fill_n(columns + count + 2, kMostLanes, 0.0F);
        for (int x = 0; x < count; x += lanes) {
            const Vec beside = hn::Add(hn::LoadU(d, columns + x), hn::LoadU(d, columns + x + 2));
            const auto v = roundedBytes(
                hn::MulAdd(sides, beside, hn::Mul(centre, hn::LoadU(d, columns + x + 1))));
            std::uint8_t* out = to + first + x;
            if (x + lanes <= count) {
                hn::StoreU(v, Bytes(), out);
            } else {
                hn::StoreU(v, Bytes(), rest);
                std::copy_n(rest, count - x, out);
            }
        }
    }
}

void HalveLumaRow(const std::uint8_t* upper, const std::uint8_t* lower, int width,
                  std::uint8_t* to) {
    const hn::ScalableTag<std::uint16_t> d16;
    const hn::RebindToSigned<decltype(d16)> dSigned;
    const hn::Rebind<std::uint8_t, decltype(d16)> d8;
    const auto lanes = static_cast<int>(hn::Lanes(d16));
    int x = 0;
    for (; x + lanes <= width; x += lanes) {
        hn::Vec<decltype(d8)> a, b, c, e;
        hn::LoadInterleaved2(d8, upper + 2 * x, a, b);
        hn::LoadInterleaved2(d8, lower + 2 * x, c, e);
        const auto above = hn::Add(hn::PromoteTo(d16, a), hn::PromoteTo(d16, b));
        const auto below = hn::Add(hn::PromoteTo(d16, c), hn::PromoteTo(d16, e));
        const auto sum = hn::Add(hn::Add(above, below), hn::Set(d16, 2));
        const auto mean = hn::BitCast(dSigned, hn::ShiftRight<2>(sum));
        hn::StoreU(hn::DemoteTo(d8, mean), d8, to + x);
    }
    for (; x < width; ++x)
        to[x] = static_cast<std::uint8_t>(
            (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1] + 2) >> 2);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(SmoothLumaRow);
HWY_EXPORT(HalveLumaRow);

void smoothLumaRow(const SmoothRows& rows, int width, float side, std::uint8_t* to) {
    HWY_DYNAMIC_DISPATCH(SmoothLumaRow)(rows, width, side, to);
}

void halveLumaRow(const std::uint8_t* upper, const std::uint8_t* lower, int width,
                  std::uint8_t* to) {
    HWY_DYNAMIC_DISPATCH(HalveLumaRow)(upper, lower, width, to);
}

}  // namespace mfar::simd
#endif
