#include "pipeline/simd/fine_rows.h"

#include "pipeline/engine/params/weigh.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/fine_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/cell_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = Cells;
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

/// Writes to the upper row the sum of each pixel's 2x2 samples [1/32 grey level]. The sum equals
/// the samples' mean in 1/128 grey level, which fits into 16 bits.
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

/// Differences between neighbouring pixels in two rows of a cell. of[i] belongs to the pixels in
/// column i. It contains the upper pixel's difference from its right neighbour, the same for the
/// lower pixel, and the difference between the lower and the upper pixel.
struct Differences {
    hn::Vec<F> of[4][3];
};

HWY_INLINE Differences DifferencesOf(const std::int16_t* upper, const std::int16_t* lower, int cell,
                                     float scale) {
    const auto unit = hn::Set(F(), scale);
    const Quads above = QuadsOf(upper, cell), below = QuadsOf(lower, cell),
                rightAbove = QuadsOf(upper + 1, cell), rightBelow = QuadsOf(lower + 1, cell);
    Differences out;
    for (int i = 0; i < 4; ++i) {
        const auto a = Wide(above.at[i]), b = Wide(below.at[i]);
        out.of[i][0] = hn::Mul(unit, hn::Sub(Wide(rightAbove.at[i]), a));
        out.of[i][1] = hn::Mul(unit, hn::Sub(Wide(rightBelow.at[i]), b));
        out.of[i][2] = hn::Mul(unit, hn::Sub(b, a));
    }
    return out;
}

void FineSumsRow(const std::array<std::int16_t*, 2>& video,
                 const std::array<std::int16_t*, 4>& still, int begin, int end, int pixels,
                 const FineSums& to) {
    const F d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    // A row of sums is half as long as the row of samples that it replaces, so it overwrites only
    // samples that are already added.
    const int last = std::min(4 * end + 1, pixels);
    SumSamples(still[0], still[1], 4 * begin, last);
    SumSamples(still[2], still[3], 4 * begin, last);
    if (last == pixels)
        for (std::int16_t* row : {video[0], video[1], still[0], still[2]})
            row[pixels] = row[pixels - 1];
    constexpr float kVideo = 1.0F / 8, kStill = 1.0F / 128;
    const auto mean = hn::Set(d, 1.0F / 24);
    for (int cell = begin; cell < end; cell += lanes) {
        const Differences v = DifferencesOf(video[0], video[1], cell, kVideo),
                          s = DifferencesOf(still[0], still[2], cell, kStill);
        auto ofVideo = hn::Zero(d), ofBoth = ofVideo, ofStill = ofVideo;
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 3; ++k) {
                const auto p = v.of[i][k], q = s.of[i][k];
                ofVideo = hn::MulAdd(p, p, ofVideo);
                ofBoth = hn::MulAdd(p, q, ofBoth);
                ofStill = hn::MulAdd(q, q, ofStill);
            }
        hn::StoreU(hn::Mul(ofVideo, mean), d, to.video + cell);
        hn::StoreU(hn::Mul(ofBoth, mean), d, to.both + cell);
        hn::StoreU(hn::Mul(ofStill, mean), d, to.still + cell);
    }
}

void FineShareRow(const FineSumsAround& sums, const float* kinks, const float* variance,
                  const FineMatch& match, int count, float* to) {
    const F d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F), least = hn::Set(d, params::kFineLeast);
    const auto room = hn::Set(d, params::kFineRoom * match.noise),
               share = hn::Set(d, params::kFineShareRoom * match.share),
               noise = hn::Set(d, params::kFineNoise * match.noise);
    for (int x = 0; x < count; x += lanes) {
        const auto video = smoothed(sums.video, x);
        const auto both = hn::Max(smoothed(sums.both, x), zero);
        const auto still = hn::Add(smoothed(sums.still, x), least);
        const auto unexplained = hn::Sub(video, hn::Div(hn::Mul(both, both), still));
        const auto allowed = hn::MulAdd(share, video, room);
        const auto limited = hn::Min(hn::Div(allowed, hn::Max(unexplained, least)), one);
        const auto roughness = hn::Div(video, hn::Add(hn::LoadU(d, variance + x), least));
        const auto rough = smoothStep(params::kFineTexture, params::kRoughTexture, roughness);
        const auto smooth = hn::MulAdd(rough, hn::Sub(one, limited), limited);
        const auto wrong = hn::Max(hn::Sub(unexplained, noise), zero);
        const auto perVideo = hn::Div(one, hn::Add(video, least));
        const auto explained = hn::NegMulAdd(wrong, perVideo, one);
        const auto explained2 = hn::Mul(explained, explained);
        const auto kink = hn::LoadU(d, kinks + x);
        const auto edge = smoothStep(params::kFlatKink, params::kSharpKink, kink);
        const auto roughEdge = smoothStep(params::kFlatRoughKink, params::kSharpRoughKink, kink);
        const auto detail = hn::Mul(still, perVideo);
        const auto alias = hn::NegMulAdd(
            rough, smoothStep(params::kAliasedStill, params::kDetailedStill, detail), rough);
        const auto kinked = hn::MulAdd(alias, hn::Sub(roughEdge, edge), edge);
        const auto kept =
            hn::MulAdd(kinked, hn::Sub(hn::Mul(explained2, explained2), smooth), smooth);
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

void fineSumsRow(const std::array<std::int16_t*, 2>& video,
                 const std::array<std::int16_t*, 4>& still, int begin, int end, int pixels,
                 const FineSums& to) {
    HWY_DYNAMIC_DISPATCH(FineSumsRow)(video, still, begin, end, pixels, to);
}

void fineShareRow(const FineSumsAround& sums, const float* kinks, const float* variance,
                  const FineMatch& match, int count, float* to) {
    HWY_DYNAMIC_DISPATCH(FineShareRow)(sums, kinks, variance, match, count, to);
}

}  // namespace mfar::simd
#endif
