#include "pipeline/simd/tile_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/tile_rows.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/tile_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Standard deviation of a Gaussian distribution with mean 0, divided by its mean absolute value.
constexpr float kMeanToDeviation = 1.2533F;
// A tile has certainly changed if Moments::over() exceeds this threshold for luma, red or blue. For
// each of the three, only one in 1e8 unchanged tiles exceeds it.
constexpr float kSurelyChanged = 40;
// A cell has certainly changed if the squared mean of its difference exceeds this multiple of the
// mean's variance.
constexpr float kCellSurelyChanged = 30;
// Variance of the difference of two pixels if each is rounded to 8 bits [grey levels^2].
constexpr float kByteRounding = 0.17F;

// In this file, each lane of a vector belongs to one tile, so that the values of a tile are added
// in the same order on every CPU.
using D = hn::CappedTag<float, kTileGroup>;
using V = hn::Vec<D>;

HWY_INLINE V Const(float value) {
    return hn::Set(D(), value);
}

HWY_INLINE void Columns(const float* row, V* out) {
    const D d;
    hn::LoadInterleaved4(d, row, out[0], out[1], out[2], out[3]);
    hn::LoadInterleaved4(d, row + 4 * hn::Lanes(d), out[4], out[5], out[6], out[7]);
#if HWY_TARGET != HWY_SCALAR
    // LoadInterleaved4 gives lanes that belong alternately to the left and the right half of a
    // tile. The loop separates the halves.
    for (int i = 0; i < 4; ++i) {
        const V first = out[i], second = out[i + 4];
        out[i] = hn::ConcatEven(d, second, first);
        out[i + 4] = hn::ConcatOdd(d, second, first);
    }
#endif
}

using Grid = V[kSide][kSide];

/// Fits a plane to 4x4 values of each tile. Returns the sum of the squared differences between the
/// values and the plane.
HWY_INLINE V BesidePlane(const Grid& values, int top, int left) {
    const V zero = hn::Zero(D());
    V sum = zero, squares = zero, slopeX = zero, slopeY = zero;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const V v = hn::Sub(values[top + y][left + x], values[top][left]);
            sum = hn::Add(sum, v);
            squares = hn::Add(squares, hn::Mul(v, v));
            slopeX = hn::Add(slopeX, hn::Mul(Const(static_cast<float>(x) - 1.5F), v));
            slopeY = hn::Add(slopeY, hn::Mul(Const(static_cast<float>(y) - 1.5F), v));
        }
    const V level = hn::Mul(hn::Mul(sum, sum), Const(1.0F / 16));
    const V slopes = hn::Add(hn::Mul(slopeX, slopeX), hn::Mul(slopeY, slopeY));
    return hn::Max(hn::Sub(hn::Sub(squares, level), hn::Div(slopes, Const(20))), zero);
}

HWY_INLINE V StructureOf(const Blocks& blocks, int tile) {
    Grid light;
    for (int y = 0; y < kSide; ++y)
        Columns(&blocks.light[y][kSide * tile], light[y]);
    V sum = hn::Zero(D());
    for (int place = 0; place < 9; ++place)
        sum = hn::Add(sum, BesidePlane(light, 2 * (place / 3), 2 * (place % 3)));
    return hn::Div(sum, Const(9));
}

/// Mean and slopes of a tile's difference (new frame minus the frame drawn last), computed from the
/// means of its 4x4 cells. over() tests whether they exceed noise: it divides the square of each of
/// these three values by its variance and returns the sum of the quotients. `variance`: variance of
/// a cell's mean.
class Moments {
public:
    HWY_INLINE Moments() : sum_(hn::Zero(D())), slopeX_(sum_), slopeY_(sum_) {}
    HWY_INLINE void add(V cellSum, int column, int row) {
        const V mean = hn::Mul(cellSum, Const(1.0F / 16));
        sum_ = hn::Add(sum_, mean);
        slopeX_ = hn::Add(slopeX_, hn::Mul(Const(static_cast<float>(column) - 1.5F), mean));
        slopeY_ = hn::Add(slopeY_, hn::Mul(Const(static_cast<float>(row) - 1.5F), mean));
    }
    HWY_INLINE V over(V variance) const {
        const V slopes = hn::Add(hn::Mul(slopeX_, slopeX_), hn::Mul(slopeY_, slopeY_));
        const V level = hn::Mul(hn::Mul(sum_, sum_), Const(1.0F / 16));
        return hn::Div(hn::Add(level, hn::Div(slopes, Const(20))), variance);
    }

private:
    V sum_, slopeX_, slopeY_;
};

HWY_INLINE Moments MomentsOf(const Blocks::CellSums& sums, int tile) {
    const hn::RebindToSigned<D> di;
    Moments out;
    for (int row = 0; row < kCells; ++row) {
        hn::Vec<decltype(di)> cell[kCells];
        hn::LoadInterleaved4(di, &sums[row][kCells * tile], cell[0], cell[1], cell[2], cell[3]);
        for (int column = 0; column < kCells; ++column)
            out.add(hn::ConvertTo(D(), cell[column]), column, row);
    }
    return out;
}

/// Sums of squares over a tile's luma difference (new frame minus the frame drawn last). Four
/// values a b above c d have the twist a - b - c + d. `means`: sum of the squared sums of all
/// blocks of 2x2 pixels. `noise`: sum of the squared twists of these blocks. `bends`: sum of the
/// squared twists of all groups of 2x2 blocks, divided by 256; the twist of a group is computed
/// from the sums of its blocks. See TileMeasure::bends.
struct LumaDifference {
    V means, bends, noise;
    Moments moments;
};

HWY_INLINE LumaDifference LumaOf(const Blocks& blocks, int tile) {
    const V zero = hn::Zero(D());
    LumaDifference out{zero, zero, zero, Moments()};
    Grid sums;
    for (int y = 0; y < kSide; ++y) {
        V twists[kSide];
        Columns(&blocks.lumaSum[y][kSide * tile], sums[y]);
        Columns(&blocks.lumaTwist[y][kSide * tile], twists);
        for (int x = 0; x < kSide; ++x) {
            out.means = hn::Add(out.means, hn::Mul(sums[y][x], sums[y][x]));
            out.noise = hn::Add(out.noise, hn::Mul(twists[x], twists[x]));
        }
    }
    for (int i = 0; i < kCells * kCells; ++i) {
        const int row = i / kCells, column = i % kCells;
        const V *upper = &sums[2 * row][2 * column], *lower = &sums[2 * row + 1][2 * column];
        const V sum = hn::Add(hn::Add(hn::Add(upper[0], upper[1]), lower[0]), lower[1]);
        out.moments.add(sum, column, row);
        const V twist = hn::Add(hn::Sub(hn::Sub(upper[0], upper[1]), lower[0]), lower[1]);
        const V bend = hn::Mul(twist, Const(1.0F / 8));
        out.bends = hn::Add(out.bends, hn::Mul(hn::Mul(bend, bend), Const(0.25F)));
    }
    return out;
}

HWY_INLINE V NoiseOf(const Blocks& blocks, int tile) {
    V sum = hn::Zero(D());
    for (int y = 0; y < kSide; ++y) {
        V rough[kSide];
        Columns(&blocks.rough[y][kSide * tile], rough);
        for (int x = 0; x < kSide; ++x)
            sum = hn::Add(sum, rough[x]);
    }
    return hn::Mul(sum, Const(kMeanToDeviation / 64));
}

/// Returns the variance of a cell's mean difference between the new frame and the frame drawn last,
/// if the cell has not changed. `variance`: variance of the difference of one pixel. `grain`: see
/// ChangeBounds.
HWY_INLINE V OfCell(V variance, float grain) {
    const V rounded = hn::Add(variance, Const(kByteRounding));
    return hn::Mul(hn::Mul(rounded, Const(1.0F / 16)), Const(grain));
}

HWY_INLINE V VarianceOf(const std::array<std::int32_t, kRowCells>& twists, int tile) {
    const hn::RebindToSigned<D> di;
    hn::Vec<decltype(di)> a, b, c, e;
    hn::LoadInterleaved4(di, &twists[kCells * tile], a, b, c, e);
    const auto sum = hn::Add(hn::Add(a, b), hn::Add(c, e));
    return hn::Mul(hn::ConvertTo(D(), sum), Const(1.0F / 256));
}

HWY_INLINE auto ChangedCells(const Blocks& blocks, int tile, V noisiest,
                             const ChangeBounds& bounds) {
    const D d;
    const hn::RebindToSigned<D> di;
    using VI = hn::Vec<decltype(di)>;
    VI out = hn::Zero(di);
    const V share = Const(1.0F / 16);
    for (int row = 0; row < kCells; ++row) {
        VI sums[kCells], absolutes[kCells];
        const int first = kCells * tile;
        hn::LoadInterleaved4(di, &blocks.farthest[row][first], sums[0], sums[1], sums[2], sums[3]);
        hn::LoadInterleaved4(di, &blocks.absolute[row][first], absolutes[0], absolutes[1],
                             absolutes[2], absolutes[3]);
        for (int column = 0; column < kCells; ++column) {
            const V mean = hn::Mul(hn::ConvertTo(d, sums[column]), share);
            const V absolute = hn::Mul(hn::ConvertTo(d, absolutes[column]), share);
            const auto isFar =
                hn::And(hn::Gt(mean, Const(bounds.mean)), hn::Gt(hn::Mul(mean, mean), noisiest));
            const auto changed = hn::Or(hn::Gt(absolute, Const(bounds.absolute)), isFar);
            const VI bit = hn::Set(di, 1 << (kCells * row + column));
            out = hn::Or(out, hn::IfThenElseZero(hn::RebindMask(di, changed), bit));
        }
    }
    return out;
}

struct Measures {
    using Values = std::array<float, kTileGroup>;
    HWY_ALIGN std::array<std::int32_t, kTileGroup> cells;
    HWY_ALIGN Values leaning, noise, structure, pixels, means, bends;
};

HWY_INLINE void Measure(const Blocks& blocks, int tile, const ChangeBounds& bounds, Measures& out) {
    const D d;
    const hn::RebindToSigned<D> di;
    const LumaDifference luma = LumaOf(blocks, tile);
    const V ofLuma = hn::Mul(luma.noise, Const(1.0F / 256));
    const V red = OfCell(VarianceOf(blocks.redTwist, tile), bounds.grain);
    const V blue = OfCell(VarianceOf(blocks.blueTwist, tile), bounds.grain);
    const V cellLuma = OfCell(ofLuma, bounds.grain);
    const V noisiest = hn::Mul(Const(kCellSurelyChanged), hn::Max(hn::Max(red, cellLuma), blue));
    hn::Store(ChangedCells(blocks, tile, noisiest, bounds), di, &out.cells[tile]);
    V leaning = luma.moments.over(cellLuma);
    leaning = hn::Max(leaning, MomentsOf(blocks.redSum, tile).over(red));
    leaning = hn::Max(leaning, MomentsOf(blocks.blueSum, tile).over(blue));
    hn::Store(leaning, d, &out.leaning[tile]);
    hn::Store(NoiseOf(blocks, tile), d, &out.noise[tile]);
    hn::Store(StructureOf(blocks, tile), d, &out.structure[tile]);
    hn::Store(ofLuma, d, &out.pixels[tile]);
    hn::Store(hn::Mul(luma.means, Const(1.0F / 256)), d, &out.means[tile]);
    hn::Store(luma.bends, d, &out.bends[tile]);
}

void MeasureTileGroup(const TilePixels& pixels, const ChangeBounds& bounds, TileMeasure* out) {
    Blocks blocks;
    Measures measures;
    ReadBlocks(pixels, blocks);
    for (int tile = 0; tile < pixels.tiles; tile += static_cast<int>(hn::Lanes(D())))
        Measure(blocks, tile, bounds, measures);
    for (std::size_t i = 0; i < static_cast<std::size_t>(pixels.tiles); ++i) {
        TileMeasure& to = out[i];
        to.changedCells = static_cast<std::uint16_t>(measures.cells[i]);
        to.changed = to.changedCells != 0 || measures.leaning[i] > kSurelyChanged;
        to.noise = measures.noise[i];
        to.structure = measures.structure[i];
        to.pixels = measures.pixels[i];
        to.means = measures.means[i];
        to.bends = measures.bends[i];
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(MeasureTileGroup);

void measureTileGroup(const TilePixels& pixels, const ChangeBounds& bounds, TileMeasure* out) {
    HWY_DYNAMIC_DISPATCH(MeasureTileGroup)(pixels, bounds, out);
}

}  // namespace mfar::simd
#endif
