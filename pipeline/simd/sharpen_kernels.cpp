#include "pipeline/simd/sharpen_kernels.h"

#include "pipeline/engine/params/detail.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/sharpen_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using I16 = hn::Rebind<std::int16_t, F>;
using U8 = hn::Rebind<std::uint8_t, F>;

constexpr std::int16_t fixed15(double value) {
    return static_cast<std::int16_t>(value * 32768 + (value < 0 ? -0.5 : 0.5));
}

// The taps of `high` in superres_sharpen.frag, grouped by distance. They add up to exactly zero.
constexpr double kNearTap = params::kSharpenNear, kFarTap = params::kSharpenFar;
constexpr std::int16_t kNear = fixed15(kNearTap - 2 * kNearTap * kNearTap);
constexpr std::int16_t kFar = fixed15(kFarTap), kDiagonal = fixed15(kNearTap * kNearTap);
constexpr std::int16_t kCentre = -4 * (kNear + kFar + kDiagonal);
// With this shift, the sum of four pixels in 1/32 grey level fits into 16 bits.
constexpr int kShift = 5;

void StrengthRow(const TrustRows& trust, int begin, int end, std::int16_t* strength) {
    const F df;
    const I16 d16;
    const int lanes = static_cast<int>(hn::Lanes(df));
    const auto t = hn::Set(df, trust.t), one = hn::Set(df, 1.0F), two = hn::Set(df, 2.0F);
    const auto between = [&](const std::array<const float*, 2>& rows, int x) HWY_ATTR {
        const auto a = hn::LoadU(df, rows[0] + x);
        return hn::MulAdd(t, hn::Sub(hn::LoadU(df, rows[1] + x), a), a);
    };
    for (int x = begin; x < end; x += lanes) {
        const auto weight = hn::Min(hn::Mul(two, between(trust.halfWeight, x)), one);
        const auto share = hn::Mul(hn::Sub(one, weight), between(trust.signal, x));
        const auto rounded = hn::NearestInt(hn::Mul(share, hn::Set(df, 32767.0F)));
        hn::StoreU(hn::DemoteTo(d16, rounded), d16, strength + x);
    }
}

HWY_INLINE hn::Vec<I16> LoadWide(const std::uint8_t* from) {
    return hn::PromoteTo(I16(), hn::LoadU(U8(), from));
}

HWY_INLINE hn::Vec<F> GreyLevels(hn::Vec<I16> fixed) {
    return hn::Mul(hn::ConvertTo(F(), hn::PromoteTo(I(), fixed)),
                   hn::Set(F(), 1.0F / (1 << kShift)));
}

HWY_INLINE hn::Vec<I16> Share(hn::Vec<I16> sum, std::int16_t tap) {
    return hn::MulFixedPoint15(hn::ShiftLeft<kShift>(sum), hn::Set(I16(), tap));
}

void SharpenRow(const std::array<const std::uint8_t*, 5>& rows, const std::int16_t* strength,
                int begin, int end, float* to) {
    const F df;
    const I16 d16;
    const int lanes = static_cast<int>(hn::Lanes(df));
    const auto most = hn::Set(d16, 255 << kShift), none = hn::Zero(d16);
    const auto both = [](const std::uint8_t* a, const std::uint8_t* b)
                          HWY_ATTR { return hn::Add(LoadWide(a), LoadWide(b)); };
    for (int x = begin; x < end; x += lanes) {
        const std::uint8_t *up = rows[1] + x, *here = rows[2] + x, *down = rows[3] + x;
        const auto centre = LoadWide(here);
        const auto near = hn::Add(both(here - 1, here + 1), both(up, down));
        const auto far = hn::Add(both(here - 2, here + 2), both(rows[0] + x, rows[4] + x));
        const auto diagonal = hn::Add(both(up - 1, up + 1), both(down - 1, down + 1));
        const auto high = hn::Add(hn::Add(Share(near, kNear), Share(far, kFar)),
                                  hn::Add(Share(diagonal, kDiagonal), Share(centre, kCentre)));
        const auto added = hn::MulFixedPoint15(high, hn::LoadU(d16, strength + x));
        const auto sum = hn::Add(hn::ShiftLeft<kShift>(centre), added);
        hn::StoreU(GreyLevels(hn::Min(hn::Max(sum, none), most)), df, to + x);
    }
}

void PlainRow(const std::uint8_t* row, int begin, int end, float* to) {
    const F df;
    const int lanes = static_cast<int>(hn::Lanes(df));
    for (int x = begin; x < end; x += lanes)
        hn::StoreU(hn::ConvertTo(df, hn::PromoteTo(I(), hn::LoadU(U8(), row + x))), df, to + x);
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(StrengthRow);
HWY_EXPORT(SharpenRow);
HWY_EXPORT(PlainRow);

void strengthRow(const TrustRows& trust, int begin, int end, std::int16_t* strength) {
    HWY_DYNAMIC_DISPATCH(StrengthRow)(trust, begin, end, strength);
}

void sharpenRow(const std::array<const std::uint8_t*, 5>& rows, const std::int16_t* strength,
                int begin, int end, float* to) {
    HWY_DYNAMIC_DISPATCH(SharpenRow)(rows, strength, begin, end, to);
}

void plainRow(const std::uint8_t* row, int begin, int end, float* to) {
    HWY_DYNAMIC_DISPATCH(PlainRow)(row, begin, end, to);
}

}  // namespace mfar::simd
#endif
