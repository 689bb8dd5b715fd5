#include "pipeline/simd/luma_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/luma_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The weights 0.299, 0.587 and 0.114 of luma, times 256. Their sum is 256.
constexpr std::uint16_t kRed = 77, kGreen = 150, kBlue = 29;

void LumaRow(const std::uint8_t* texels, bool bgr, std::size_t pixels, std::uint8_t* luma) {
    const hn::ScalableTag<std::uint16_t> d16;
    const hn::RebindToSigned<decltype(d16)> dSigned;
    const hn::Rebind<std::uint8_t, decltype(d16)> d8;
    const std::size_t lanes = hn::Lanes(d16);
    const auto first = hn::Set(d16, bgr ? kBlue : kRed), third = hn::Set(d16, bgr ? kRed : kBlue);
    const auto green = hn::Set(d16, kGreen), half = hn::Set(d16, 128);
    std::size_t i = 0;
    for (; i + lanes <= pixels; i += lanes) {
        hn::Vec<decltype(d8)> a, b, c, alpha;
        hn::LoadInterleaved4(d8, texels + 4 * i, a, b, c, alpha);
        auto sum = hn::Add(hn::Mul(hn::PromoteTo(d16, a), first), half);
        sum = hn::Add(sum, hn::Mul(hn::PromoteTo(d16, b), green));
        sum = hn::Add(sum, hn::Mul(hn::PromoteTo(d16, c), third));
        const auto mean = hn::BitCast(dSigned, hn::ShiftRight<8>(sum));
        hn::StoreU(hn::DemoteTo(d8, mean), d8, luma + i);
    }
    const unsigned w0 = bgr ? kBlue : kRed, w2 = bgr ? kRed : kBlue;
    for (; i < pixels; ++i) {
        const std::uint8_t* t = texels + 4 * i;
        luma[i] = static_cast<std::uint8_t>((t[0] * w0 + t[1] * kGreen + t[2] * w2 + 128) >> 8);
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(LumaRow);

void lumaRow(const std::uint8_t* texels, bool bgr, std::size_t pixels, std::uint8_t* luma) {
    HWY_DYNAMIC_DISPATCH(LumaRow)(texels, bgr, pixels, luma);
}

}  // namespace mfar::simd
#endif
