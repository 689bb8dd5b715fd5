#include "pipeline/simd/subpixel_rows.h"

#include "pipeline/engine/params/flow.h"
#include "pipeline/engine/params/weigh.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/subpixel_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// These must come after foreach_target.h, because they are compiled once per instruction set.
#include "pipeline/simd/cell_place-inl.h"
#include "pipeline/simd/still_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kSamples = 2 * kCell + 2;  // samples along an axis of a cell, plus one on each side

HWY_INLINE Place PlaceOf(const LookUpParams& lookUp, const SubpixelCells& cells, int x) {
    const D d;
    const auto pointOf = [&](const float* vx, const float* vy)
                             HWY_ATTR { return Point{hn::LoadU(d, vx + x), hn::LoadU(d, vy + x)}; };
    return PlaceOf(lookUp, hn::Iota(d, static_cast<float>(x)), Const(static_cast<float>(cells.row)),
                   pointOf(cells.flowX, cells.flowY), pointOf(cells.alongX[0], cells.alongX[1]),
                   pointOf(cells.alongY[0], cells.alongY[1]));
}

class Sums {
public:
    HWY_INLINE Sums() {
        for (V& mean : mean_)
            mean = Const(0);
        for (V& sum : sum_)
            sum = Const(0);
    }
    HWY_INLINE void add(V v, V s, V x, V y) {
        const V of[4] = {v, s, x, y};
        for (int i = 0; i < 4; ++i)
            mean_[i] = hn::Add(mean_[i], of[i]);
        product(VS, v, s);
        product(SS, s, s);
        product(VX, v, x);
        product(VY, v, y);
        product(SX, s, x);
        product(SY, s, y);
        product(XX, x, x);
        product(XY, x, y);
        product(YY, y, y);
        product(VV, v, v);
    }
    HWY_INLINE void store(hn::Mask<D> counts, int x,
                          const std::array<float*, kSubpixelSums>& to) const {
        constexpr int kV = 0, kS = 1, kX = 2, kY = 3;
        constexpr int kFactors[kSubpixelSums][2] = {{kV, kS}, {kS, kS}, {kV, kX}, {kV, kY},
                                                    {kS, kX}, {kS, kY}, {kX, kX}, {kX, kY},
                                                    {kY, kY}, {kV, kV}};
        const V perPixel = Const(1.0F / (kCell * kCell));
        for (std::size_t i = 0; i < kSubpixelSums; ++i) {
            const V means = hn::Mul(mean_[kFactors[i][0]], mean_[kFactors[i][1]]);
            const V sum = hn::NegMulAdd(means, perPixel, sum_[i]);
            hn::StoreU(hn::IfThenElseZero(counts, sum), D(), to[i] + x);
        }
    }

private:
    HWY_INLINE void product(SubpixelSum which, V a, V b) {
        sum_[which] = hn::MulAdd(a, b, sum_[which]);
    }
    V mean_[4], sum_[kSubpixelSums];
};

/// The still's luma at 10x10 positions, half a video pixel apart, around a cell.
class Seen {
public:
    HWY_INLINE Seen(const StillPairs& still, const Place& place) {
        const StillBlocks blocks(still);
        const auto offset = [](int i) {
            return 0.5F * static_cast<float>(i) - 0.25F * (kSamples - 1);
        };
        for (int j = 0; j < kSamples; ++j)
            for (int i = 0; i < kSamples; ++i) {
                const Point p = PointNear(place, offset(i), offset(j));
                const Positions at = PositionsWithin(still.size, p.x, p.y);
                samples_[j][i] = MeanOfFour(blocks.scattered(at.x, at.y), at);
            }
    }
    /// Returns the mean of the 2x2 samples from column i and row j on [grey levels].
    HWY_INLINE V mean(int i, int j) const {
        const V sum = hn::Add(hn::Add(samples_[j][i], samples_[j][i + 1]),
                              hn::Add(samples_[j + 1][i], samples_[j + 1][i + 1]));
        return hn::Mul(sum, Const(1.0F / 1024));
    }
    /// Returns the mean of the squares of the same samples [grey levels^2].
    HWY_INLINE V meanSquare(int i, int j) const {
        const V *upper = samples_[j] + i, *lower = samples_[j + 1] + i;
        const V above = hn::MulAdd(upper[0], upper[0], hn::Mul(upper[1], upper[1]));
        const V all = hn::MulAdd(lower[0], lower[0], hn::MulAdd(lower[1], lower[1], above));
        return hn::Mul(all, Const(1.0F / (256 * 1024)));
    }

private:
    V samples_[kSamples][kSamples];
};

/// Luma of the still as a video pixel sees it, and its derivatives; see params::kSubpixelReach.
struct SeenPixel {
    V luma, alongX, alongY;
};

template <bool kOfLight>
HWY_INLINE SeenPixel PixelOf(const Seen& seen, int column, int row, float light) {
    const int c = 2 * column + 1, r = 2 * row + 1;
    SeenPixel out{seen.mean(c, r), hn::Sub(seen.mean(c + 1, r), seen.mean(c - 1, r)),
                  hn::Sub(seen.mean(c, r + 1), seen.mean(c, r - 1))};
    if constexpr (kOfLight) {
        const V root = hn::Sqrt(seen.meanSquare(c, r));
        const V perRoot = hn::Div(Const(0.5F), hn::Max(root, Const(1)));
        const auto mix = [&](V mean, V ofLight) HWY_ATTR {
            return hn::MulAdd(hn::Sub(ofLight, mean), Const(light), mean);
        };
        out.luma = mix(out.luma, root);
        out.alongX =
            mix(out.alongX,
                hn::Mul(perRoot, hn::Sub(seen.meanSquare(c + 1, r), seen.meanSquare(c - 1, r))));
        out.alongY =
            mix(out.alongY,
                hn::Mul(perRoot, hn::Sub(seen.meanSquare(c, r + 1), seen.meanSquare(c, r - 1))));
    }
    // Small numbers have small rounding errors.
    out.luma = hn::Add(out.luma, Const(-128));
    return out;
}

template <bool kOfLight>
void SumsOf(const LookUpParams& lookUp, const StillPairs& still, const SubpixelCells& cells, int x,
            const std::array<float*, kSubpixelSums>& to) {
    const Place place = PlaceOf(lookUp, cells, x);
    const Seen seen(still, place);
    Sums sums;
    for (int j = 0; j < kCell; ++j) {
        hn::Vec<I16> v[4];
        hn::LoadInterleaved4(I16(), cells.video[static_cast<std::size_t>(j)] + kCell * x, v[0],
                             v[1], v[2], v[3]);
        for (int i = 0; i < kCell; ++i) {
            const SeenPixel pixel = PixelOf<kOfLight>(seen, i, j, cells.light);
            sums.add(VideoAt(v[i]), pixel.luma, pixel.alongX, pixel.alongY);
        }
    }
    const auto counts = hn::Gt(hn::LoadU(D(), cells.compared + x), Const(0));
    sums.store(hn::And(counts, place.isInside), x, to);
}

void SubpixelSumsRow(const LookUpParams& lookUp, const StillPairs& still,
                     const SubpixelCells& cells, int begin, int end,
                     const std::array<float*, kSubpixelSums>& to) {
    const D d;
    const auto sums = cells.light > 0 ? SumsOf<true> : SumsOf<false>;
    for (int x = begin; x < end; x += static_cast<int>(hn::Lanes(d)))
        if (!hn::AllFalse(d, hn::Gt(hn::LoadU(d, cells.compared + x), Const(0))))
            sums(lookUp, still, cells, x, to);
}

/// Weighted sums over a cell and its neighbours; `sum` is indexed by SubpixelSum. (awayX, awayY) is
/// the sum of the vectors M d. M is the matrix [XX, XY; XY, YY] of a neighbour's sums. d is the
/// neighbour's flow minus the flow that a plane through the cell's flow has at the neighbour.
struct Around {
    V sum[kSubpixelSums];
    V awayX, awayY;
};

HWY_INLINE const float* RowOf(const RowsAround& rows, int j) {
    return j < 0 ? rows.above : j == 0 ? rows.here : rows.below;
}

HWY_INLINE void AddNeighbour(const SubpixelAround& in, int x, int i, int j, Around& to) {
    const D d;
    const V right = Const(static_cast<float>(kCell * i)),
            down = Const(static_cast<float>(kCell * j));
    const auto away = [&](const RowsAround& flow, std::size_t k) HWY_ATTR {
        const V alongX = hn::LoadU(d, in.alongX[k] + x), alongY = hn::LoadU(d, in.alongY[k] + x);
        const V plane =
            hn::MulAdd(right, alongX, hn::MulAdd(down, alongY, hn::LoadU(d, flow.here + x)));
        return hn::Sub(hn::LoadU(d, RowOf(flow, j) + x + i), plane);
    };
    const V dx = away(in.flowX, 0), dy = away(in.flowY, 1);
    const V off = hn::Mul(hn::MulAdd(dx, dx, hn::Mul(dy, dy)),
                          Const(1 / (params::kSubpixelReach * params::kSubpixelReach)));
    const auto binomial = static_cast<float>((i == 0 ? 2 : 1) * (j == 0 ? 2 : 1));
    // A neighbour whose flow is NaN does not count, because the comparison is then false.
    const auto isNear = hn::Lt(off, Const(1));
    const V weight =
        hn::IfThenElseZero(isNear, hn::NegMulAdd(Const(binomial), off, Const(binomial)));
    V of[kSubpixelSums];
    for (std::size_t k = 0; k < kSubpixelSums; ++k) {
        of[k] = hn::Mul(weight, hn::LoadU(d, RowOf(in.sums[k], j) + x + i));
        to.sum[k] = hn::Add(to.sum[k], of[k]);
    }
    const V nearX = hn::IfThenElseZero(isNear, dx), nearY = hn::IfThenElseZero(isNear, dy);
    to.awayX = hn::MulAdd(of[XX], nearX, hn::MulAdd(of[XY], nearY, to.awayX));
    to.awayY = hn::MulAdd(of[XY], nearX, hn::MulAdd(of[YY], nearY, to.awayY));
}

/// Returns the Gauss-Newton step [px]; 0 if the gain is too small or the step too long.
HWY_INLINE Point StepOf(const Around& in, float noise) {
    const auto& s = in.sum;
    const V gain = hn::Div(s[VS], hn::Add(s[SS], Const(noise)));
    const V gain2 = hn::Mul(gain, gain);
    const auto errorAlong = [&](V video, V still, V away) HWY_ATTR {
        return hn::MulAdd(gain2, away, hn::Mul(gain, hn::NegMulAdd(gain, still, video)));
    };
    const V x = errorAlong(s[VX], s[SX], in.awayX), y = errorAlong(s[VY], s[SY], in.awayY);
    const V unexplained = hn::Max(hn::NegMulAdd(gain, s[VS], s[VV]), Const(0));
    constexpr float kPerError2 =
        1 / (params::kSubpixelPixels * params::kSubpixelError * params::kSubpixelError);
    const V damping = hn::Mul(hn::Add(unexplained, Const(noise)), Const(kPerError2));
    const V xx = hn::MulAdd(gain2, s[XX], damping), yy = hn::MulAdd(gain2, s[YY], damping);
    const V xy = hn::Mul(gain2, s[XY]);
    const V perDeterminant = hn::Div(Const(1), hn::NegMulAdd(xy, xy, hn::Mul(xx, yy)));
    const V dx = hn::Mul(hn::NegMulAdd(xy, y, hn::Mul(yy, x)), perDeterminant);
    const V dy = hn::Mul(hn::NegMulAdd(xy, x, hn::Mul(xx, y)), perDeterminant);
    constexpr float kLongest2 = params::kSubpixelLongest * params::kSubpixelLongest;
    const auto takes = hn::And(hn::Ge(gain, Const(params::kLeastSubpixelGain)),
                               hn::Lt(hn::MulAdd(dx, dx, hn::Mul(dy, dy)), Const(kLongest2)));
    return {hn::IfThenElseZero(takes, dx), hn::IfThenElseZero(takes, dy)};
}

void SubpixelStepRow(const SubpixelAround& in, int begin, int end, float* flowX, float* flowY) {
    const D d;
    const float noise = params::kSubpixelPixels * (in.noise * in.noise + params::kByteVariance);
    for (int x = begin; x < end; x += static_cast<int>(hn::Lanes(d))) {
        Around around;
        for (V& sum : around.sum)
            sum = Const(0);
        around.awayX = around.awayY = Const(0);
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                AddNeighbour(in, x, i, j, around);
        const Point step = StepOf(around, noise);
        hn::StoreU(hn::Add(hn::LoadU(d, in.flowX.here + x), step.x), d, flowX + x);
        hn::StoreU(hn::Add(hn::LoadU(d, in.flowY.here + x), step.y), d, flowY + x);
    }
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(SubpixelSumsRow);
HWY_EXPORT(SubpixelStepRow);

void subpixelSumsRow(const LookUpParams& lookUp, const StillPairs& still,
                     const SubpixelCells& cells, int begin, int end,
                     const std::array<float*, kSubpixelSums>& to) {
    HWY_DYNAMIC_DISPATCH(SubpixelSumsRow)(lookUp, still, cells, begin, end, to);
}

void subpixelStepRow(const SubpixelAround& in, int begin, int end, float* flowX, float* flowY) {
    HWY_DYNAMIC_DISPATCH(SubpixelStepRow)(in, begin, end, flowX, flowY);
}

}  // namespace mfar::simd
#endif
