#include "pipeline/simd/visibility_rows.h"

#include "pipeline/engine/params/occlusion.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/visibility_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kTaps = 16;
using D = hn::CappedTag<float, kTaps>;
using V = hn::Vec<D>;

HWY_INLINE V Const(float value) {
    return hn::Set(D(), value);
}

bool Decide(const DecideRow& row, const VisibilityParams& params) {
    const D d;
    const hn::RebindToSigned<D> di;
    const hn::Rebind<std::uint8_t, D> d8;
    const V hidden = Const(1 + params.bounds.hidden * params.virtualSigma);
    bool anyOpen = false;
    for (int x = 0; x < row.count; x += static_cast<int>(hn::Lanes(d))) {
        const V z = hn::LoadU(d, row.z + x);
        const auto there = hn::And(hn::Gt(z, Const(params::kLeastVirtualDepth)),
                                   hn::Lt(z, Const(params::kMostVirtualDepth)));
        const V inverse = hn::Div(Const(1), hn::IfThenElse(there, z, Const(1)));
        const auto before = hn::Ge(inverse, hn::LoadU(d, row.greatest + x));
        const auto behind = hn::Le(hn::Mul(inverse, hidden), hn::LoadU(d, row.least + x));
        const auto open = hn::AndNot(hn::Or(before, behind), there);
        const auto seen = hn::IfThenElse(open, Const(kOpen),
                                         hn::IfThenElseZero(hn::And(there, before), Const(255)));
        hn::StoreU(hn::DemoteTo(d8, hn::ConvertTo(di, seen)), d8, row.visibility + x);
        hn::StoreU(inverse, d, row.inverse + x);
        anyOpen = anyOpen || !hn::AllFalse(d, open);
    }
    return anyOpen;
}

/// Returns e^x for x <= 0, with an error below 1e-5. It is computed as 2^y. A polynomial
/// approximates 2 to the power of y's fractional part.
HWY_INLINE V Exp(V x) {
    const hn::RebindToSigned<D> di;
    const V power = hn::Max(hn::Mul(x, Const(1.44269504F)), Const(-100));
    const V whole = hn::Floor(power), rest = hn::Sub(power, whole);
    V p = hn::MulAdd(rest, Const(0.0136703F), Const(0.0517450F));
    p = hn::MulAdd(rest, p, Const(0.2416044F));
    p = hn::MulAdd(rest, p, Const(0.6929729F));
    p = hn::MulAdd(rest, p, Const(1.0000035F));
    const auto scale = hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127));
    return hn::Mul(p, hn::BitCast(D(), hn::ShiftLeft<23>(scale)));
}

HWY_INLINE V ReciprocalSqrt(V v) {
    const V first = hn::ApproximateReciprocalSqrt(v);
    const V halved = hn::Mul(Const(0.5F), v);
    return hn::Mul(first, hn::NegMulAdd(hn::Mul(halved, first), first, Const(1.5F)));
}

/// The 4x4 depth samples around an output pixel. Output pixels between the same samples use the
/// same Taps.
struct Taps {
    using Values = std::array<float, kTaps>;
    HWY_ALIGN Values inverse, variance, red, green, blue;
    HWY_ALIGN Values rowWeights;
};

void ReadTaps(const SampleWindow& samples, int column, Taps& out) {
    for (std::size_t j = 0; j < 4; ++j) {
        const SampleRow& row = samples.rows[j];
        std::copy_n(row.inverse + column, 4, &out.inverse[4 * j]);
        std::copy_n(row.variance + column, 4, &out.variance[4 * j]);
        std::copy_n(row.red + column, 4, &out.red[4 * j]);
        std::copy_n(row.green + column, 4, &out.green[4 * j]);
        std::copy_n(row.blue + column, 4, &out.blue[4 * j]);
    }
}

HWY_INLINE V ColumnWeights(const float* weights, std::size_t tap) {
#if HWY_TARGET == HWY_SCALAR
    return hn::LoadU(D(), weights + tap % 4);
#else
    static_cast<void>(tap);
    return hn::LoadDup128(D(), weights);
#endif
}

std::uint8_t WeighPixel(const Taps& taps, const float* columnWeights, std::uint32_t colour,
                        float inverse, const VisibilityParams& params) {
    const D d;
    const V red = Const(static_cast<float>(colour & 0xFFU));
    const V green = Const(static_cast<float>(colour >> 8 & 0xFFU));
    const V blue = Const(static_cast<float>(colour >> 16 & 0xFFU));
    const float ofVirtual = params.virtualSigma * inverse;
    V sum = hn::Zero(d), weights = hn::Zero(d);
    for (std::size_t i = 0; i < kTaps; i += hn::Lanes(d)) {
        const V r = hn::Sub(hn::Load(d, &taps.red[i]), red);
        const V g = hn::Sub(hn::Load(d, &taps.green[i]), green);
        const V b = hn::Sub(hn::Load(d, &taps.blue[i]), blue);
        const V unlike = hn::MulAdd(r, r, hn::MulAdd(g, g, hn::Mul(b, b)));
        // If no sample has a similar colour, kLikenessFloor lets the distance determine the weight.
        const V like =
            hn::Add(Exp(hn::Mul(unlike, Const(-params.likeness))), Const(params::kLikenessFloor));
        const V tent = hn::Mul(hn::Load(d, &taps.rowWeights[i]), ColumnWeights(columnWeights, i));
        const V weight = hn::Mul(tent, like);
        const V variance = hn::Max(
            hn::Add(hn::Load(d, &taps.variance[i]), Const(ofVirtual * ofVirtual)), Const(1e-18F));
        const V nearer = hn::Sub(hn::Load(d, &taps.inverse[i]), Const(inverse));
        const V sigmas = hn::Mul(nearer, ReciprocalSqrt(variance));
        const V beyond =
            hn::Mul(hn::Sub(sigmas, Const(params.bounds.bias)), Const(params.perSoftness));
        const V t = hn::Max(hn::Min(beyond, Const(1)), Const(0));
        const V hides = hn::Mul(hn::Mul(t, t), hn::NegMulAdd(Const(2), t, Const(3)));
        sum = hn::Add(sum, hn::NegMulAdd(weight, hides, weight));
        weights = hn::Add(weights, weight);
    }
    const float share =
        hn::GetLane(hn::SumOfLanes(d, sum)) / hn::GetLane(hn::SumOfLanes(d, weights));
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F)));
}

void WeighOpenPixels(const OpenRow& row, const SampleWindow& samples,
                     const VisibilityParams& params) {
    Taps taps;
    for (std::size_t j = 0; j < 4; ++j)
        std::fill_n(&taps.rowWeights[4 * j], 4, samples.weights[j]);
    int read = -1;
    for (int x = 0; x < row.count; ++x) {
        if (row.visibility[x] != kOpen) continue;
        if (row.column[x] != read) ReadTaps(samples, read = row.column[x], taps);
        row.visibility[x] = WeighPixel(taps, row.weights + 4 * static_cast<std::ptrdiff_t>(x),
                                       row.picture[x], row.inverse[x], params);
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(Decide);
HWY_EXPORT(WeighOpenPixels);

VisibilityParams::VisibilityParams(const CompositeOptions& options)
    : bounds{static_cast<float>(options.bias), static_cast<float>(options.bias + options.softness)},
      perSoftness(static_cast<float>(1 / options.softness)),
      virtualSigma(static_cast<float>(options.virtualSigma)),
      likeness(static_cast<float>(0.5 / (options.likeness * options.likeness))) {}

bool decideRow(const DecideRow& row, const VisibilityParams& params) {
    return HWY_DYNAMIC_DISPATCH(Decide)(row, params);
}

void weighOpenPixels(const OpenRow& row, const SampleWindow& samples,
                     const VisibilityParams& params) {
    HWY_DYNAMIC_DISPATCH(WeighOpenPixels)(row, samples, params);
}

}  // namespace mfar::simd
#endif
