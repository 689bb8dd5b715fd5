// Compares patches of two luma pictures (levels of two pyramids) for a batch of cells. An offset or
// a gain between the pictures does not change the result. This header is included once per
// instruction set.
#if defined(MFAR_PATCH_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_PATCH_BATCH_INL_H
#undef MFAR_PATCH_BATCH_INL_H
#else
#define MFAR_PATCH_BATCH_INL_H
#endif

#include "pipeline/simd/patch_inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {

struct alignas(64) Each {
    float of[kBatch] = {};

    [[nodiscard]] HWY_INLINE Vec at(std::size_t i) const { return hn::Load(Cells(), of + i); }
    HWY_INLINE void set(std::size_t i, Vec v) { hn::Store(v, Cells(), of + i); }
};
struct Each2 {
    Each x, y;
};
struct Lanes2 {
    Vec x, y;
};
HWY_INLINE Lanes2 at(const Each2& e, std::size_t i) {
    return {e.x.at(i), e.y.at(i)};
}
HWY_INLINE void set(Each2& e, std::size_t i, const Lanes2& v) {
    e.x.set(i, v.x);
    e.y.set(i, v.y);
}
HWY_INLINE Vec squaredLength(const Lanes2& v) {
    return hn::MulAdd(v.x, v.x, hn::Mul(v.y, v.y));
}

struct Batch {
    int count = 0;
    int column[kBatch], row[kBatch];
    Patch patch[kBatch];
    Each mean, variance;  // mean of the patch's pixels, and sum of (pixel - mean)^2
    Each2 sumG, sumAG;    // sums of the gradients, and of (pixel - mean) times gradient
    Each inverseXx, inverseXy, inverseYy;

    Each2 best;
    Each cost;
    Each2 descent;  // right-hand side of the Gauss-Newton step

    Each2 trial;
    // Before a comparison: 1 if the cell's vector `trial` must be compared, else 0. After it: 1 if
    // `trial` cost less than `best`, else 0.
    Each active;

    HWY_INLINE void add(int c, int r) {
        column[count] = c;
        row[count] = r;
        ++count;
    }
};

/// Loads the patches of the batch's cells. Computes the sums that depend only on the patches.
HWY_INLINE void loadPatches(const PatchPicture& p, PatchSums& sums, Batch& batch) {
    for (int i = 0; i < batch.count; ++i)
        loadPatch(p, batch.column[i], batch.row[i], i, batch.patch[i], sums);
    const Cells d;
    const auto share = hn::Set(d, 1 / kPixels), damping = hn::Set(d, params::kPatchDamping);
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
        const Vec a = sums.a.sum(i, 1), mean = hn::Mul(a, share);
        const Lanes2 g{sums.x.sum(i, 0.5F), sums.y.sum(i, 0.5F)};
        batch.mean.set(i, mean);
        batch.variance.set(i, hn::Max(hn::NegMulAdd(a, mean, sums.aa.sum(i, 1)), hn::Zero(d)));
        set(batch.sumG, i, g);
        set(batch.sumAG, i,
            {hn::NegMulAdd(mean, g.x, sums.ax.sum(i, 0.5F)),
             hn::NegMulAdd(mean, g.y, sums.ay.sum(i, 0.5F))});
        const Lanes2 meanG{hn::Mul(g.x, share), hn::Mul(g.y, share)};
        const Vec xx = hn::NegMulAdd(g.x, meanG.x, hn::Add(sums.xx.sum(i, 0.25F), damping));
        const Vec xy = hn::NegMulAdd(g.x, meanG.y, sums.xy.sum(i, 0.25F));
        const Vec yy = hn::NegMulAdd(g.y, meanG.y, hn::Add(sums.yy.sum(i, 0.25F), damping));
        const Vec det = hn::NegMulAdd(xy, xy, hn::Mul(xx, yy));
        const Vec scale = hn::Div(hn::Set(d, 1.0F), hn::Max(det, hn::Set(d, 1.0F)));
        batch.inverseXx.set(i, hn::Mul(yy, scale));
        batch.inverseXy.set(i, hn::Neg(hn::Mul(xy, scale)));
        batch.inverseYy.set(i, hn::Mul(xx, scale));
    }
}

/// Replaces `best` by `trial` in active cells where `trial` costs less. Deactivates all other
/// cells.
HWY_INLINE void takeBetter(const CompareSums& sums, Batch& batch) {
    const Cells d;
    const auto noise = hn::Set(d, params::kPatchNoise), zero = hn::Zero(d), one = hn::Set(d, 1.0F);
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
        const Vec b = sums.b.sum(i, 1 / kValue), mean = hn::Mul(b, hn::Set(d, 1 / kPixels));
        const Vec bb = sums.bb.sum(i, 1 / (kValue * kValue)), variance = batch.variance.at(i);
        const Vec varianceB = hn::Max(hn::NegMulAdd(b, mean, bb), zero);
        const Vec covariance = hn::NegMulAdd(batch.mean.at(i), b, sums.ab.sum(i, 1 / kValue));
        const Vec squaredGain = hn::Div(hn::Add(variance, noise), hn::Add(varianceB, noise));
        const Vec gain = hn::Sqrt(squaredGain);
        const Vec energy = hn::MulAdd(squaredGain, varianceB, variance);
        const Vec off = hn::NegMulAdd(hn::Add(gain, gain), covariance, energy);
        const Vec cost = hn::Div(hn::Max(off, zero), hn::Add(energy, noise));
        const auto better =
            hn::And(hn::Gt(batch.active.at(i), zero), hn::Lt(cost, batch.cost.at(i)));
        const Lanes2 sumG = at(batch.sumG, i), sumAG = at(batch.sumAG, i);
        const auto descent = [&](Vec gb, Vec g, Vec ag) HWY_ATTR {
            return hn::NegMulAdd(gain, hn::NegMulAdd(mean, g, gb), ag);
        };
        const auto take = [&](Each& now, Vec v)
                              HWY_ATTR { now.set(i, hn::IfThenElse(better, v, now.at(i))); };
        take(batch.cost, cost);
        take(batch.best.x, batch.trial.x.at(i));
        take(batch.best.y, batch.trial.y.at(i));
        take(batch.descent.x, descent(sums.xb.sum(i, 0.5F / kValue), sumG.x, sumAG.x));
        take(batch.descent.y, descent(sums.yb.sum(i, 0.5F / kValue), sumG.y, sumAG.y));
        batch.active.set(i, hn::IfThenElseZero(better, one));
    }
}

/// Indices of a batch's active cells. They are found without a branch per cell.
struct ActiveCells {
    int count = 0;
    int cell[kBatch];

    HWY_INLINE explicit ActiveCells(const Batch& batch) {
        for (int i = 0; i < batch.count; ++i) {
            cell[count] = i;
            count += batch.active.of[i] > 0 ? 1 : 0;
        }
    }
};

template <class Compare>
HWY_INLINE void tryActive(const Compare& compare, const CompareSums& sums, Batch& batch) {
    const ActiveCells active(batch);
    if (active.count == 0) return;
    for (int k = 0; k < active.count; ++k)
        compare(active.cell[k]);
    takeBetter(sums, batch);
}

/// Sets `trial` of each active cell to the result of one Gauss-Newton step, which is at most a
/// pixel long. Deactivates cells whose step is shorter than params::kShortestStep allows.
HWY_INLINE void stepActive(Batch& batch) {
    const Cells d;
    const auto one = hn::Set(d, 1.0F);
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
        const Lanes2 by = at(batch.descent, i), best = at(batch.best, i);
        const Vec xy = batch.inverseXy.at(i);
        const Lanes2 s{hn::MulAdd(batch.inverseXx.at(i), by.x, hn::Mul(xy, by.y)),
                       hn::MulAdd(xy, by.x, hn::Mul(batch.inverseYy.at(i), by.y))};
        const Vec squared = squaredLength(s);
        const Vec shrink = hn::Div(one, hn::Sqrt(hn::Max(squared, one)));
        set(batch.trial, i, {hn::MulAdd(s.x, shrink, best.x), hn::MulAdd(s.y, shrink, best.y)});
        const auto goesOn = hn::Gt(squared, hn::Set(d, params::kShortestStep));
        batch.active.set(i, hn::IfThenElseZero(goesOn, batch.active.at(i)));
    }
}

HWY_INLINE void putBest(const FlowPlanes& field, const Batch& batch, int i) {
    const std::ptrdiff_t at = batch.row[i] * field.pitch + batch.column[i];
    field.x[at] = batch.best.x.of[i];
    field.y[at] = batch.best.y.of[i];
    field.cost[at] = batch.cost.of[i];
    field.texture[at] = batch.variance.of[i];
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
