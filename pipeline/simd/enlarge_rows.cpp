#include "pipeline/simd/enlarge_rows.h"

#include "pipeline/enlarge/filter_layout.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/enlarge_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;
using namespace enlarge;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using I16Half = hn::Rebind<std::int16_t, F>;
using U16Half = hn::Rebind<std::uint16_t, F>;
using I16 = hn::ScalableTag<std::int16_t>;
using U8 = hn::Rebind<std::uint8_t, I16>;

constexpr std::int16_t fixed15(double value) {
    return static_cast<std::int16_t>(value * 32768 + (value < 0 ? -0.5 : 0.5));
}
// Half the weights of red, green and blue in luma, as 15-bit fractions. A byte is multiplied by 128
// (the largest power of two with which it fits into int16) and by half its weight. The sum of the
// three products is the luma in units of 1/64 grey level. The halved weights add up to exactly 1/2,
// so that the luma of grey is exact.
constexpr std::int16_t kRed = fixed15(0.299 / 2), kBlue = fixed15(0.114 / 2);
constexpr std::int16_t kGreen = 16384 - kRed - kBlue;

void LumaEighthsRow(const std::array<const std::uint8_t*, 3>& rgb, int begin, int end,
                    std::int16_t* to) {
    const I16 d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    HWY_ALIGN std::uint8_t rest[hn::MaxLanes(I16())] = {};
    for (int x = begin; x < end; x += lanes) {
        const auto share = [&](std::size_t channel, std::int16_t weight) HWY_ATTR {
            const std::uint8_t* from = rgb[channel] + x;
            if (x + lanes > end) {
                std::memcpy(rest, from, static_cast<std::size_t>(end - x));
                from = rest;
            }
            const auto wide = hn::PromoteTo(d, hn::LoadU(U8(), from));
            return hn::MulFixedPoint15(hn::ShiftLeft<7>(wide), hn::Set(d, weight));
        };
        const auto sum = hn::Add(hn::Add(share(0, kRed), share(1, kGreen)), share(2, kBlue));
        hn::StoreU(hn::ShiftRight<3>(hn::Add(sum, hn::Set(d, 4))), d, to + x);
    }
}

HWY_INLINE hn::Vec<F> Widened(hn::Vec<I16Half> v) {
    return hn::ConvertTo(F(), hn::PromoteTo(I(), v));
}
HWY_INLINE hn::Vec<F> Steps(const std::int16_t* plus, const std::int16_t* minus) {
    const I16Half d;
    return Widened(hn::Sub(hn::LoadU(d, plus), hn::LoadU(d, minus)));
}

HWY_INLINE hn::Vec<F> Step(hn::Vec<F> value, float from, float weight = 1) {
    return hn::IfThenElseZero(hn::Ge(value, hn::Set(F(), from)), hn::Set(F(), weight));
}

/// Returns the bin of an angle, see Symmetry. `cosine`, `sine`: cosine and sine of twice the angle,
/// multiplied by the same positive number.
template <int kBins>
HWY_INLINE hn::Vec<F> AngleBin(hn::Vec<F> cosine, hn::Vec<F> sine) {
    static_assert(kBins == 8 || kBins == 16);
    const F d;
    const auto c = hn::Abs(cosine), s = hn::Abs(sine), one = hn::Set(d, 1.0F);
    auto bin = hn::IfThenElseZero(hn::Gt(s, c), one);
    if constexpr (kBins == 16) {
        const auto low = hn::Gt(s, hn::Mul(c, hn::Set(d, params::kLowTangent)));
        const auto high = hn::Gt(s, hn::Mul(c, hn::Set(d, params::kHighTangent)));
        bin = hn::Add(bin, hn::Add(hn::IfThenElseZero(low, one), hn::IfThenElseZero(high, one)));
    }
    const auto left = hn::Lt(cosine, hn::Zero(d)), lower = hn::Lt(sine, hn::Zero(d));
    const auto descends = hn::Xor(left, lower);
    bin = hn::IfThenElse(descends, hn::Sub(hn::Set(d, 0.5F * kBins - 1), bin), bin);
    return hn::Add(bin, hn::IfThenElse(lower, hn::Zero(d), hn::Set(d, kBins / 2.0F)));
}

HWY_INLINE void StoreClass(hn::Vec<F> number, std::uint16_t* to) {
    hn::StoreU(hn::DemoteTo(U16Half(), hn::ConvertTo(I(), number)), U16Half(), to);
}

void SumColumns(const std::array<const std::int16_t*, 7>& luma, int begin, int end,
                const std::array<float*, 3>& sums) {
    const F d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int x = begin; x < end; x += lanes) {
        auto xx = hn::Zero(d), xy = xx, yy = xx;
        for (std::size_t k = 0; k < 5; ++k) {
            const auto gx = Steps(luma[k + 1] + x + 1, luma[k + 1] + x - 1);
            const auto gy = Steps(luma[k + 2] + x, luma[k] + x);
            xx = hn::MulAdd(gx, gx, xx);
            xy = hn::MulAdd(gx, gy, xy);
            yy = hn::MulAdd(gy, gy, yy);
        }
        hn::StoreU(xx, d, sums[0] + x);
        hn::StoreU(xy, d, sums[1] + x);
        hn::StoreU(yy, d, sums[2] + x);
    }
}

HWY_INLINE hn::Vec<F> SumOfFive(const float* at) {
    const F d;
    const auto sides = hn::Add(hn::LoadU(d, at - 1), hn::LoadU(d, at + 1));
    const auto far = hn::Add(hn::LoadU(d, at - 2), hn::LoadU(d, at + 2));
    return hn::Add(hn::LoadU(d, at), hn::Add(sides, far));
}

HWY_INLINE hn::Vec<F> GradientClass(hn::Vec<F> xx, hn::Vec<F> xy, hn::Vec<F> yy) {
    using C = GradientClasses;
    const F d;
    // Factor that converts a squared strength [(grey levels / px)^2] to the unit of `twiceLargest`,
    // which is twice the largest eigenvalue. An eigenvalue is a sum of 25 squared differences [1/8
    // grey level] between pixels at a distance of 2 px.
    constexpr float kScale = 2.0F * 25 * (2 * kLumaScale) * (2 * kLumaScale);
    const auto sum = hn::Add(xx, yy), cosine = hn::Sub(xx, yy), sine = hn::Add(xy, xy);
    const auto spread = hn::Sqrt(hn::MulAdd(cosine, cosine, hn::Mul(sine, sine)));
    const auto twiceLargest = hn::Add(sum, spread);
    auto kind = hn::Zero(d);
    for (const float from : C::kStrengthFrom)
        kind = hn::Add(kind, Step(twiceLargest, from * from * kScale, 3));
    for (const float from : C::kCoherenceFrom) {
        // Tests (s1 - s2) / (s1 + s2) >= from, where s1 and s2 are the square roots of the
        // eigenvalues. The test needs only the sum and the difference of the eigenvalues.
        const float share = 2 * from / (1 + from * from);
        kind = hn::Add(kind, Step(hn::Sub(spread, hn::Mul(sum, hn::Set(d, share))), 0));
    }
    const auto bin = AngleBin<C::kAngles>(cosine, sine);
    return hn::MulAdd(bin, hn::Set(d, static_cast<float>(C::kKinds)), kind);
}

HWY_INLINE hn::Vec<F> CurvatureClass(const std::array<const std::int16_t*, 3>& luma, int x) {
    using C = CurvatureClasses;
    const F d;
    const I16Half d16;
    const auto at = [&](std::size_t row, int dx)
                        HWY_ATTR { return hn::LoadU(d16, luma[row] + x + dx); };
    const auto twice = hn::Add(at(1, 0), at(1, 0));
    const auto xx = Widened(hn::Sub(hn::Add(at(1, -1), at(1, 1)), twice));
    const auto yy = Widened(hn::Sub(hn::Add(at(0, 0), at(2, 0)), twice));
    const auto fourXy =
        Widened(hn::Sub(hn::Add(at(2, 1), at(0, -1)), hn::Add(at(2, -1), at(0, 1))));
    const auto sum = hn::Add(xx, yy), cosine = hn::Sub(xx, yy);
    const auto sine = hn::Mul(fourXy, hn::Set(d, 0.5F));
    const auto square = hn::MulAdd(cosine, cosine, hn::Mul(sine, sine));
    auto kind = hn::Zero(d);
    for (const float from : C::kLaplacianFrom)
        kind = hn::Add(kind, Step(sum, from * kLumaScale, 4));
    for (const float from : C::kDifferenceFrom)
        kind = hn::Add(kind, Step(square, from * from * kLumaScale * kLumaScale));
    const auto bin = AngleBin<C::kAngles>(cosine, sine);
    return hn::MulAdd(bin, hn::Set(d, static_cast<float>(C::kKinds)), kind);
}

void ClassRow(const std::array<const std::int16_t*, 7>& luma, int begin, int end,
              const std::array<float*, 3>& sums, std::uint16_t* gradient,
              std::uint16_t* curvature) {
    SumColumns(luma, begin - 2, end + 2, sums);
    const int lanes = static_cast<int>(hn::Lanes(F()));
    for (int x = begin; x < end; x += lanes) {
        StoreClass(
            GradientClass(SumOfFive(sums[0] + x), SumOfFive(sums[1] + x), SumOfFive(sums[2] + x)),
            gradient + x);
        StoreClass(CurvatureClass({luma[2], luma[3], luma[4]}, x), curvature + x);
    }
}

void RangeRow(const std::array<const std::int16_t*, 5>& luma, int begin, int end,
              std::int16_t* lowest, std::int16_t* highest) {
    const I16 d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int x = begin; x < end; x += lanes) {
        const auto centre = hn::LoadU(d, luma[2] + x);
        auto low = centre, high = centre;
        for (const std::int16_t* row : luma)
            for (int dx = -2; dx <= 2; ++dx) {
                const auto v = hn::LoadU(d, row + x + dx);
                low = hn::Min(low, v);
                high = hn::Max(high, v);
            }
        const auto more = hn::ShiftRight<kOvershootShift>(hn::Sub(high, low));
        hn::StoreU(hn::Sub(hn::Sub(low, more), centre), d, lowest + x);
        hn::StoreU(hn::Sub(hn::Add(high, more), centre), d, highest + x);
    }
}

/// Right shift that converts products of filter weight and luma to units of the residual
/// (1 / kResidualScale grey level).
constexpr int kSumShift = 12;
static_assert(kWeightScale * kLumaScale == kResidualScale << kSumShift);

HWY_INLINE std::int32_t PairAt(const std::int16_t* at) {
    std::int32_t out = 0;
    std::memcpy(&out, at, sizeof(out));
    return out;
}
HWY_INLINE std::int32_t PairOf(std::int16_t first, std::int16_t second) {
    const std::int16_t both[] = {first, second};
    return PairAt(both);
}
/// Loads the neighbours of a pixel in the order of kTapAt.
HWY_INLINE void PairsAround(const std::array<const std::int16_t*, 5>& luma, int x,
                            std::int32_t* pairs) {
    constexpr std::size_t kRows[] = {0, 1, 3, 4};
    for (std::size_t i = 0; i < 4; ++i) {
        pairs[2 * i] = PairAt(luma[kRows[i]] + x - 2);
        pairs[2 * i + 1] = PairAt(luma[kRows[i]] + x);
    }
    pairs[8] = PairAt(luma[2] + x - 2);
    pairs[9] = PairAt(luma[2] + x + 1);
    pairs[10] = PairOf(luma[0][x + 2], luma[1][x + 2]);
    pairs[11] = PairOf(luma[3][x + 2], luma[4][x + 2]);
}

#if HWY_TARGET == HWY_SCALAR
void ResidualOf(const ResidualInput& in, const FilterRows& filters, int x, std::int16_t* out) {
    std::int32_t pairs[kPairs];
    PairsAround(in.luma, x, pairs);
    std::int16_t taps[kTaps];
    std::memcpy(taps, pairs, sizeof(taps));
    const std::int16_t* gradient = filters.gradient + in.gradient[x] * filters.gradientPitch;
    const std::int16_t* curvature = filters.curvature + in.curvature[x] * filters.curvaturePitch;
    for (int phase = 0; phase < kPhases; ++phase) {
        std::int32_t sum = 0, cubic = 0;
        for (int tap = 0; tap < kTaps; ++tap) {
            const int at = filterIndex(tap, phase), step = taps[tap] - in.luma[2][x];
            sum += step * (gradient[at] + curvature[at]);
            cubic += step * filters.cubic[at];
        }
        const std::int32_t limited =
            std::clamp(sum + cubic, in.lowest[x] * kWeightScale, in.highest[x] * kWeightScale);
        const std::int32_t rounded = (limited - cubic + (1 << (kSumShift - 1))) >> kSumShift;
        out[phase] = static_cast<std::int16_t>(std::clamp(rounded, -32768, 32767));
    }
}
#else
HWY_INLINE void ResidualOf(const ResidualInput& in, const FilterRows& filters, int x,
                           std::int16_t* out) {
    const hn::CappedTag<std::int16_t, 2 * kPhases> d16;
    const hn::RepartitionToWide<decltype(d16)> d32;
    const hn::Rebind<std::int16_t, decltype(d32)> dOut;
    constexpr std::size_t kLanes = hn::MaxLanes(d16), kParts = 2 * kPhases / kLanes;
    using V = hn::Vec<decltype(d32)>;
    HWY_ALIGN std::int32_t pairs[kPairs];
    PairsAround(in.luma, x, pairs);
    const std::int16_t* gradient = filters.gradient + in.gradient[x] * filters.gradientPitch;
    const std::int16_t* curvature = filters.curvature + in.curvature[x] * filters.curvaturePitch;
    const auto centre = hn::Set(d16, in.luma[2][x]);
    V sum[kParts], sum1[kParts], cubic[kParts], cubic1[kParts];
    for (std::size_t p = 0; p < kParts; ++p)
        sum[p] = sum1[p] = cubic[p] = cubic1[p] = hn::Zero(d32);
    for (std::size_t i = 0; i < kPairs; ++i) {
        const auto step = hn::Sub(hn::BitCast(d16, hn::Set(d32, pairs[i])), centre);
        for (std::size_t p = 0; p < kParts; ++p) {
            const std::size_t at = 2 * kPhases * i + kLanes * p;
            const auto add = [&](const std::int16_t* filter, V& low, V& high) HWY_ATTR {
                low =
                    hn::ReorderWidenMulAccumulate(d32, step, hn::Load(d16, filter + at), low, high);
            };
            add(gradient, sum[p], sum1[p]);
            add(curvature, sum[p], sum1[p]);
            add(filters.cubic, cubic[p], cubic1[p]);
        }
    }
    const auto lowest = hn::Set(d32, in.lowest[x] * kWeightScale),
               highest = hn::Set(d32, in.highest[x] * kWeightScale),
               half = hn::Set(d32, 1 << (kSumShift - 1));
    for (std::size_t p = 0; p < kParts; ++p) {
        const V up = hn::RearrangeToOddPlusEven(cubic[p], cubic1[p]);
        const V all = hn::Add(hn::RearrangeToOddPlusEven(sum[p], sum1[p]), up);
        const V limited = hn::Sub(hn::Min(hn::Max(all, lowest), highest), up);
        const V rounded = hn::ShiftRight<kSumShift>(hn::Add(limited, half));
        hn::StoreU(hn::DemoteTo(dOut, rounded), dOut, out + kLanes / 2 * p);
    }
}
#endif

void ResidualRows(const ResidualInput& in, const FilterRows& filters, int begin, int end,
                  const std::array<std::int16_t*, 4>& to) {
    HWY_ALIGN std::int16_t residual[kPhases];
    for (int x = begin; x < end; ++x) {
        ResidualOf(in, filters, x, residual);
        for (std::size_t row = 0; row < kGrid; ++row)
            std::memcpy(to[row] + kGrid * x, residual + kGrid * row, kGrid * sizeof(*residual));
    }
}

void MixedRow(const std::int16_t* a, const std::int16_t* b, float t, int begin, int end,
              float* to) {
    const F d;
    const I16Half d16;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int x = begin; x < end; x += lanes) {
        const auto from = Widened(hn::LoadU(d16, a + x));
        const auto step = hn::Sub(Widened(hn::LoadU(d16, b + x)), from);
        hn::StoreU(hn::MulAdd(step, hn::Set(d, t), from), d, to + x);
    }
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(LumaEighthsRow);
HWY_EXPORT(ClassRow);
HWY_EXPORT(RangeRow);
HWY_EXPORT(ResidualRows);
HWY_EXPORT(MixedRow);

void lumaEighthsRow(const std::array<const std::uint8_t*, 3>& rgb, int begin, int end,
                    std::int16_t* to) {
    HWY_DYNAMIC_DISPATCH(LumaEighthsRow)(rgb, begin, end, to);
}

void classRow(const std::array<const std::int16_t*, 7>& luma, int begin, int end,
              const std::array<float*, 3>& sums, std::uint16_t* gradient,
              std::uint16_t* curvature) {
    HWY_DYNAMIC_DISPATCH(ClassRow)(luma, begin, end, sums, gradient, curvature);
}

void rangeRow(const std::array<const std::int16_t*, 5>& luma, int begin, int end,
              std::int16_t* lowest, std::int16_t* highest) {
    HWY_DYNAMIC_DISPATCH(RangeRow)(luma, begin, end, lowest, highest);
}

void residualRows(const ResidualInput& in, const FilterRows& filters, int begin, int end,
                  const std::array<std::int16_t*, 4>& to) {
    HWY_DYNAMIC_DISPATCH(ResidualRows)(in, filters, begin, end, to);
}

void mixedRow(const std::int16_t* a, const std::int16_t* b, float t, int begin, int end,
              float* to) {
    HWY_DYNAMIC_DISPATCH(MixedRow)(a, b, t, begin, end, to);
}

}  // namespace mfar::simd
#endif
