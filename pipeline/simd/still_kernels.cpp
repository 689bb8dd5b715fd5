#include "pipeline/simd/still_kernels.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/still_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using I16 = hn::ScalableTag<std::int16_t>;
using U16 = hn::RebindToUnsigned<I16>;
using U8 = hn::Rebind<std::uint8_t, I16>;

HWY_INLINE hn::Vec<I16> LoadWide(const std::uint8_t* from) {
    return hn::PromoteTo(I16(), hn::LoadU(U8(), from));
}

HWY_INLINE hn::Vec<U8> Bytes(hn::Vec<I16> fixed) {
    return hn::DemoteTo(U8(), hn::ShiftRight<5>(hn::Add(fixed, hn::Set(I16(), 16))));
}

HWY_INLINE hn::Vec<U8> LumaOf(hn::Vec<I16> y, const std::int16_t* chroma, const LumaGain& by) {
    const I16 d;
    const auto scaled = hn::MulFixedPoint15(hn::ShiftLeft<6>(y), hn::Set(d, by.gain));
    const auto sum = hn::Add(scaled, hn::Set(d, by.offset));
    return Bytes(chroma == nullptr ? sum : hn::Add(sum, hn::LoadU(d, chroma)));
}

/// Computes luma in whole vectors, from rows with `kStep` bytes per pixel. The last vector is read
/// from a copy, because cameras' rows have no padding.
template <int kStep, class Load>
HWY_INLINE void LumaRows(const std::uint8_t* from, const std::int16_t* chroma, const LumaGain& by,
                         std::size_t pixels, std::uint8_t* luma, const Load& load) {
    const std::size_t lanes = hn::Lanes(I16());
    HWY_ALIGN std::uint8_t rest[kStep * hn::MaxLanes(I16())] = {};
    for (std::size_t x = 0; x < pixels; x += lanes) {
        const std::uint8_t* at = from + kStep * x;
        if (x + lanes > pixels) {
            std::memcpy(rest, at, kStep * (pixels - x));
            at = rest;
        }
        hn::StoreU(LumaOf(load(at), chroma == nullptr ? nullptr : chroma + x, by), U8(), luma + x);
    }
}

void LumaOfPlane(const std::uint8_t* y, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma) {
    LumaRows<1>(y, chroma, by, pixels, luma,
                [](const std::uint8_t* at) HWY_ATTR { return LoadWide(at); });
}

void LumaOfPairs(const std::uint8_t* yAndChroma, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma) {
    LumaRows<2>(yAndChroma, chroma, by, pixels, luma, [](const std::uint8_t* at) HWY_ATTR {
        hn::Vec<U8> y, between;
        hn::LoadInterleaved2(U8(), at, y, between);
        return hn::PromoteTo(I16(), y);
    });
}

HWY_INLINE hn::Vec<I16> Raised(const std::array<const std::uint8_t*, 3>& luma, hn::Vec<I16> share,
                               std::size_t x) {
    const std::uint8_t* at = luma[1] + x;
    const auto here = LoadWide(at);
    const auto beside = hn::Add(hn::Add(LoadWide(at - 1), LoadWide(at + 1)),
                                hn::Add(LoadWide(luma[0] + x), LoadWide(luma[2] + x)));
    const auto high = hn::ShiftLeft<5>(hn::Sub(hn::ShiftLeft<2>(here), beside));
    return hn::Add(hn::ShiftLeft<5>(here), hn::MulFixedPoint15(high, share));
}

void RaisedRow(const std::array<const std::uint8_t*, 3>& luma, std::int16_t neighboursShare,
               std::size_t pixels, std::uint8_t* to) {
    const I16 d;
    const auto share = hn::Set(d, neighboursShare);
    for (std::size_t x = 0; x < pixels; x += hn::Lanes(d))
        hn::StoreU(Bytes(Raised(luma, share, x)), U8(), to + x);
}

void QuietRow(const std::array<const std::uint8_t*, 3>& luma, float noise, std::size_t pixels,
              std::uint8_t* to) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> whole;
    const hn::Rebind<std::uint8_t, decltype(d)> bytes;
    const auto least = hn::Set(d, noise), ninth = hn::Set(d, 1.0F / 9);
    for (std::size_t x = 0; x < pixels; x += hn::Lanes(d)) {
        const auto load = [&](int row, int column) HWY_ATTR {
            return hn::ConvertTo(d, hn::PromoteTo(whole, hn::LoadU(bytes, luma[row] + x + column)));
        };
        const auto here = load(1, 0);
        auto sum = hn::Zero(d), squares = hn::Zero(d);
        for (int i = 0; i < 9; ++i) {
            const auto off = hn::Sub(load(i / 3, i % 3 - 1), here);
            sum = hn::Add(sum, off);
            squares = hn::MulAdd(off, off, squares);
        }
        const auto mean = hn::Mul(sum, ninth);
        const auto variance = hn::NegMulAdd(mean, mean, hn::Mul(squares, ninth));
        const auto removed = hn::Div(least, hn::Max(variance, least));
        const auto quiet = hn::NearestInt(hn::MulAdd(removed, mean, here));
        hn::StoreU(hn::DemoteTo(bytes, quiet), bytes, to + x);
    }
}

void PairRows(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t pixels,
              std::uint16_t* pairs) {
    const U16 d;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t x = 0; x < pixels; x += lanes) {
        const auto low = hn::PromoteTo(d, hn::LoadU(U8(), upper + x));
        const auto high = hn::PromoteTo(d, hn::LoadU(U8(), lower + x));
        hn::StoreU(hn::Or(low, hn::ShiftLeft<8>(high)), d, pairs + x);
    }
}

void PackRow(const std::array<const std::uint8_t*, 3>& rgb, std::size_t pixels,
             std::uint32_t* rgba) {
    // Each iteration writes only one vector of the result, so that less than one vector is written
    // beyond the end.
    const hn::Rebind<std::uint16_t, hn::ScalableTag<std::uint32_t>> d;
    const hn::Rebind<std::uint8_t, decltype(d)> d8;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t x = 0; x < pixels; x += lanes) {
        const auto load = [&](std::size_t channel) HWY_ATTR {
            return hn::PromoteTo(d, hn::LoadU(d8, rgb[channel] + x));
        };
        const auto low = hn::Or(load(0), hn::ShiftLeft<8>(load(1)));
        const auto high = hn::Or(load(2), hn::Set(d, 0xff00));
        hn::StoreInterleaved2(low, high, d, reinterpret_cast<std::uint16_t*>(rgba + x));
    }
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(LumaOfPlane);
HWY_EXPORT(LumaOfPairs);
HWY_EXPORT(RaisedRow);
HWY_EXPORT(QuietRow);
HWY_EXPORT(PairRows);
HWY_EXPORT(PackRow);

void lumaOfPlane(const std::uint8_t* y, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma) {
    HWY_DYNAMIC_DISPATCH(LumaOfPlane)(y, chroma, by, pixels, luma);
}

void lumaOfPairs(const std::uint8_t* yAndChroma, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma) {
    HWY_DYNAMIC_DISPATCH(LumaOfPairs)(yAndChroma, chroma, by, pixels, luma);
}

void raisedRow(const std::array<const std::uint8_t*, 3>& luma, std::int16_t neighboursShare,
               std::size_t pixels, std::uint8_t* to) {
    HWY_DYNAMIC_DISPATCH(RaisedRow)(luma, neighboursShare, pixels, to);
}

void quietRow(const std::array<const std::uint8_t*, 3>& luma, float noise, std::size_t pixels,
              std::uint8_t* to) {
    HWY_DYNAMIC_DISPATCH(QuietRow)(luma, noise, pixels, to);
}

void pairRows(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t pixels,
              std::uint16_t* pairs) {
    HWY_DYNAMIC_DISPATCH(PairRows)(upper, lower, pixels, pairs);
}

void packRow(const std::array<const std::uint8_t*, 3>& rgb, std::size_t pixels,
             std::uint32_t* rgba) {
    HWY_DYNAMIC_DISPATCH(PackRow)(rgb, pixels, rgba);
}

}  // namespace mfar::simd
#endif
