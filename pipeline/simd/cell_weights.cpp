#include "pipeline/simd/cell_weights.h"

#include "pipeline/engine/params/weigh.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/cell_weights.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/cell_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kChunk = 16;
using D = Cells;
using V = hn::Vec<D>;
using LowRow = std::array<float, kChunk>;

HWY_INLINE V Const(float value) {
    return hn::Set(D(), value);
}

HWY_INLINE V Mix(V a, V b, V share) {
    return hn::MulAdd(hn::Sub(b, a), share, a);
}

/// Returns how strongly one component of the flow changes around a cell [px^2]: the squared
/// difference of the left and right neighbours plus the squared difference of the upper and lower
/// neighbours. The neighbours are 8 px apart.
HWY_INLINE V Bend(const RowsAround& flow, int x) {
    const D d;
    const V dx = hn::Sub(hn::LoadU(d, flow.here + x + 1), hn::LoadU(d, flow.here + x - 1));
    const V dy = hn::Sub(hn::LoadU(d, flow.below + x), hn::LoadU(d, flow.above + x));
    return hn::MulAdd(dx, dx, hn::Mul(dy, dy));
}

/// Returns the squared horizontal second difference plus the squared vertical second difference of
/// one component of the flow [px^2].
HWY_INLINE V Tear(const RowsAround& flow, int x) {
    const D d;
    const V here = hn::Add(hn::LoadU(d, flow.here + x), hn::LoadU(d, flow.here + x));
    const auto change = [&](const float* before, const float* after) HWY_ATTR {
        return hn::Sub(hn::Add(hn::LoadU(d, before), hn::LoadU(d, after)), here);
    };
    const V dx = change(flow.here + x - 1, flow.here + x + 1);
    const V dy = change(flow.above + x, flow.below + x);
    return hn::MulAdd(dx, dx, hn::Mul(dy, dy));
}

HWY_INLINE void HalfAround(const WeighRow::Half& rows, int chunk, LowRow& out) {
    const hn::CappedTag<float, kChunk / 2> d;
    for (int i = 0; i < kChunk / 2; i += static_cast<int>(hn::Lanes(d))) {
        const int x = chunk / 2 + i;
        const auto column = [&](int at) HWY_ATTR {
            return hn::Add(hn::LoadU(d, rows.near + at), hn::LoadU(d, rows.other + at));
        };
        const auto quarter = hn::Set(d, 0.25F);
        const auto here = column(x);
        hn::StoreInterleaved2(hn::Mul(hn::Add(column(x - 1), here), quarter),
                              hn::Mul(hn::Add(here, column(x + 1)), quarter), d, &out[2 * i]);
    }
}

/// The flow of four cells in a row or column, one component. The flow may jump between the middle
/// two.
struct FourCells {
    V first, second, third, fourth;
};

/// Returns `value` where the flow jumps, otherwise 0; see params::kJump.
HWY_INLINE V Jump(const FourCells& x, const FourCells& y, float value) {
    const auto squared = [](V dx, V dy) HWY_ATTR { return hn::MulAdd(dx, dx, hn::Mul(dy, dy)); };
    const V here = squared(hn::Sub(x.third, x.second), hn::Sub(y.third, y.second));
    const V before = squared(hn::Sub(x.second, x.first), hn::Sub(y.second, y.first));
    const V after = squared(hn::Sub(x.fourth, x.third), hn::Sub(y.fourth, y.third));
    const V limit = hn::MulAdd(Const(params::kJumpPerChange), hn::Sqrt(hn::Max(before, after)),
                               Const(params::kJump));
    return hn::IfThenElseZero(hn::Gt(hn::Sqrt(here), limit), Const(value));
}

HWY_INLINE V JumpsOf(const WeighRow& row, int x) {
    const D d;
    const auto across = [&](const float* flow) HWY_ATTR {
        return FourCells{hn::LoadU(d, flow + x - 1), hn::LoadU(d, flow + x),
                         hn::LoadU(d, flow + x + 1), hn::LoadU(d, flow + x + 2)};
    };
    const auto down = [&](const RowsAround& flow, const float* below2) HWY_ATTR {
        return FourCells{hn::LoadU(d, flow.above + x), hn::LoadU(d, flow.here + x),
                         hn::LoadU(d, flow.below + x), hn::LoadU(d, below2 + x)};
    };
    return hn::Add(
        Jump(across(row.flowX.here), across(row.flowY.here), params::kJumpRight),
        Jump(down(row.flowX, row.flowX2), down(row.flowY, row.flowY2), params::kJumpBelow));
}

struct Weight {
    V weight, signal, unexplained, kink, variance;
};

HWY_INLINE Weight WeightOf(const WeighRow& row, int x, V low, V lowStill, V confidence,
                           float sigma) {
    const V zero = Const(0);
    const V video = smoothed(row.varianceVideo, x), still = smoothed(row.varianceStill, x);
    const V covariance = hn::Max(smoothed(row.covariance, x), zero);
    const float ofPatch = params::kPatchPixels * (sigma * sigma + params::kByteVariance);
    const float ofLow = params::kPatchPixels * (0.25F * sigma * sigma + params::kByteVariance);
    const V noise = Const(ofPatch), lowNoise = Const(ofLow);
    const V perStill = hn::Div(Const(1), hn::Add(still, noise));
    const V perVideo = hn::Div(Const(1), hn::Add(video, noise));
    const V fine = hn::Mul(covariance, perStill);
    const V lowGain = hn::Div(hn::Max(low, zero), hn::Add(lowStill, lowNoise));
    const V lowShare =
        hn::Div(lowStill, hn::MulAdd(Const(params::kLowContrast), lowNoise, lowStill));
    const V gain =
        hn::Min(Mix(fine, hn::Max(fine, lowGain), lowShare), Const(params::kLargestGain));
    const V ncc2 = hn::Mul(hn::Mul(covariance, perVideo), fine);
    const V bend =
        hn::Mul(hn::Sqrt(hn::Add(Bend(row.flowX, x), Bend(row.flowY, x))), Const(1.0F / 8));
    const V even = hn::Mul(smoothStep(params::kUnlikePatches, params::kAlikePatches, ncc2),
                           Const(params::kLookUpLoss));
    const V bent = smoothStep(params::kEvenFlow, params::kBentFlow, bend);
    const V trust = Mix(even, hn::Mul(ncc2, ncc2), bent);
    const V tear = hn::Sqrt(hn::Add(Tear(row.flowX, x), Tear(row.flowY, x)));
    const V whole = hn::Sub(Const(1), smoothStep(params::kSmoothStep, params::kTornStep, tear));
    const V weight = hn::Mul(hn::Mul(gain, trust), hn::Mul(confidence, whole));
    // A cell gets weight 0 if the flow of an adjacent cell is NaN. Then `bend` is NaN, so bend ==
    // bend is false.
    const auto counts = hn::And(hn::Gt(weight, Const(params::kSmallestWeight)), hn::Eq(bend, bend));
    const V signal = hn::Mul(hn::NegMulAdd(Const(2), noise, video), perVideo);
    const auto textured =
        hn::Ge(video, Const(params::kTexturedContrast * (ofPatch + params::kPatchPixels)));
    const auto unlike = hn::Le(hn::Mul(ncc2, confidence), Const(params::kUnexplainedMatch));
    return {hn::IfThenElseZero(counts, weight), hn::Max(hn::Min(signal, Const(1)), zero),
            hn::IfThenElseZero(hn::And(textured, unlike), Const(1)), hn::Mul(bent, tear),
            hn::Mul(video, Const(1 / params::kPatchPixels))};
}

void WeighCells(const WeighRow& row, float noise) {
    const D d;
    HWY_ALIGN LowRow low, lowStill;
    for (int chunk = 0; chunk < row.count; chunk += kChunk) {
        HalfAround(row.halfCovariance, chunk, low);
        HalfAround(row.halfVarianceStill, chunk, lowStill);
        for (int i = 0; i < kChunk; i += static_cast<int>(hn::Lanes(d))) {
            const int x = chunk + i;
            const V confidence = hn::LoadU(d, row.confidence + x);
            const Weight w = WeightOf(row, x, hn::Load(d, &low[i]), hn::Load(d, &lowStill[i]),
                                      confidence, noise);
            hn::StoreInterleaved4(hn::LoadU(d, row.flowX.here + x),
                                  hn::LoadU(d, row.flowY.here + x), w.weight, confidence, d,
                                  &row.weighed[x].x);
            hn::StoreInterleaved4(hn::LoadU(d, row.lookX + x), hn::LoadU(d, row.lookY + x),
                                  w.weight, hn::Add(confidence, JumpsOf(row, x)), d,
                                  &row.lookUps[x].x);
            hn::StoreInterleaved4(hn::Min(hn::Mul(w.weight, Const(0.5F)), Const(1)), confidence,
                                  w.signal, w.unexplained, d, &row.trust[x].halfWeight);
            hn::StoreU(w.kink, d, row.kink + x);
            hn::StoreU(w.variance, d, row.variance + x);
        }
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(WeighCells);

void weighCells(const WeighRow& row, float noise) {
    HWY_DYNAMIC_DISPATCH(WeighCells)(row, noise);
}

}  // namespace mfar::simd
#endif
