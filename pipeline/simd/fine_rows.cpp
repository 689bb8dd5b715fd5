#include "pipeline/simd/fine_rows.h"

#include "pipeline/engine/params/weigh.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/fine_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 16>;
using I16 = hn::Rebind<std::int16_t, F>;

HWY_INLINE hn::Vec<F> Wide(hn::Vec<I16> values) {
    return hn::ConvertTo(F(), hn::PromoteTo(hn::Rebind<std::int32_t, F>(), values));
}

struct Quads {
    hn::Vec<I16> at[4];
};

HWY_INLINE Quads QuadsOf(const std::int16_t* row, int cell) {
    Quads out;
    hn::LoadInterleaved4(I16(), row + 4 * cell, out.at[0], out.at[1], out.at[2], out.at[3]);
    return out;
}

/// Writes to the upper row the sum of each pixel's 2x2 samples [1/32 grey level]. It equals their
/// mean in 1/128 grey level, which fits into 16 bits.
HWY_INLINE void SumSamples(std::int16_t* upper, const std::int16_t* lower, int begin, int end) {
    const I16 d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int x = begin; x < end; x += lanes) {
        hn::Vec<I16> a, b, c, e;
        hn::LoadInterleaved2(d, upper + 2 * x, a, b);
        hn::LoadInterleaved2(d, lower + 2 * x, c, e);
        hn::StoreU(hn::Add(hn::Add(a, b), hn::Add(c, e)), d, upper + x);
    }
}

void FineSumsRow(const std::array<const std::int16_t*, 2>& video,
                 const std::array<std::int16_t*, 4>& still, int begin, int end,
                 const FineSums& to) {
    const F d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    // A row of sums is half as long as the row of samples that it replaces, so it overwrites only
    // samples that are already added.
    SumSamples(still[0], still[1], 4 * begin, 4 * end);
    SumSamples(still[2], still[3], 4 * begin, 4 * end);
    constexpr float kVideo = 1.0F / 8, kStill = 1.0F / 128;
    const auto scaleVideo = hn::Set(d, kVideo), scaleStill = hn::Set(d, kStill);
    const auto quarter = hn::Set(d, 0.25F), eighth = hn::Set(d, 1.0F / 8);
    for (int cell = begin; cell < end; cell += lanes) {
        const Quads v[2] = {QuadsOf(video[0], cell), QuadsOf(video[1], cell)};
        const Quads s[2] = {QuadsOf(still[0], cell), QuadsOf(still[2], cell)};
        auto ofVideo = hn::Zero(d), ofBoth = ofVideo, ofStill = ofVideo;
        for (int block = 0; block < 2; ++block) {
            hn::Vec<F> a[4], b[4];
            for (int i = 0; i < 4; ++i) {
                a[i] = hn::Mul(Wide(v[i / 2].at[2 * block + i % 2]), scaleVideo);
                b[i] = hn::Mul(Wide(s[i / 2].at[2 * block + i % 2]), scaleStill);
            }
            const auto meanOf = [&](const hn::Vec<F>* of) HWY_ATTR {
                return hn::Mul(hn::Add(hn::Add(of[0], of[1]), hn::Add(of[2], of[3])), quarter);
            };
            const auto meanA = meanOf(a), meanB = meanOf(b);
            for (int i = 0; i < 4; ++i) {
                const auto p = hn::Sub(a[i], meanA), q = hn::Sub(b[i], meanB);
                ofVideo = hn::MulAdd(p, p, ofVideo);
                ofBoth = hn::MulAdd(p, q, ofBoth);
                ofStill = hn::MulAdd(q, q, ofStill);
            }
        }
        hn::StoreU(hn::Mul(ofVideo, eighth), d, to.video + cell);
        hn::StoreU(hn::Mul(ofBoth, eighth), d, to.both + cell);
        hn::StoreU(hn::Mul(ofStill, eighth), d, to.still + cell);
    }
}

HWY_INLINE hn::Vec<F> Smoothed(const FineSumsNear::Pair& rows, int x) {
    const F d;
    const auto column = [&](int at) HWY_ATTR {
        return hn::Add(hn::LoadU(d, rows.above + at), hn::LoadU(d, rows.below + at));
    };
    return hn::Mul(hn::MulAdd(hn::Set(d, 2.0F), column(x), hn::Add(column(x - 1), column(x + 1))),
                   hn::Set(d, 1.0F / 8));
}

void FineShareRow(const FineSumsNear& sums, const FineMatch& match, int count, float* to) {
    const F d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const auto one = hn::Set(d, 1.0F);
    const auto noise = hn::Set(d, params::kFineRoom * match.noise),
               share = hn::Set(d, params::kFineShareRoom * match.share);
    for (int x = 0; x < count; x += lanes) {
        const auto video = Smoothed(sums.video, x);
        const auto both = hn::Max(Smoothed(sums.both, x), hn::Zero(d));
        const auto still = hn::Add(Smoothed(sums.still, x), hn::Set(d, params::kFineLeast));
        const auto unexplained = hn::Sub(video, hn::Div(hn::Mul(both, both), still));
        const auto allowed = hn::MulAdd(share, video, noise);
        const auto kept = hn::Div(allowed, hn::Max(unexplained, hn::Set(d, params::kFineLeast)));
        // If `kept` is NaN, the comparison is false, and the cell keeps its whole weight.
        hn::StoreU(hn::IfThenElse(hn::Lt(kept, one), kept, one), d, to + x);
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(FineSumsRow);
HWY_EXPORT(FineShareRow);

void fineSumsRow(const std::array<const std::int16_t*, 2>& video,
                 const std::array<std::int16_t*, 4>& still, int begin, int end,
                 const FineSums& to) {
    HWY_DYNAMIC_DISPATCH(FineSumsRow)(video, still, begin, end, to);
}

void fineShareRow(const FineSumsNear& sums, const FineMatch& match, int count, float* to) {
    HWY_DYNAMIC_DISPATCH(FineShareRow)(sums, match, count, to);
}

}  // namespace mfar::simd
#endif
