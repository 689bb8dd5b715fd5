// Computes sums over blocks of 2x2 pixels for a group of tiles, from the new frame and from the
// frame with which each tile was last drawn. This header is included once per instruction set.
#include "pipeline/engine/params/luma.h"
#include "pipeline/simd/tile_rows.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <hwy/highway.h>

#if defined(MFAR_SIMD_TILE_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_TILE_BLOCKS_INL_H
#undef MFAR_SIMD_TILE_BLOCKS_INL_H
#else
#define MFAR_SIMD_TILE_BLOCKS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kRed = params::kLumaRed, kGreen = params::kLumaGreen, kBlue = params::kLumaBlue;

constexpr int kSide = kTileSize / 2;  // side of a tile [blocks of 2x2 pixels]
constexpr int kCells = 4;             // side of a tile [cells of 2x2 blocks]
constexpr int kRowBlocks = kSide * kTileGroup;
constexpr int kRowCells = kCells * kTileGroup;

/// Measurements of a group of tiles, one for each block of 2x2 pixels or for each cell. A block
/// with the pixels a b above c d has the sum a + b + c + d and the twist a - b - c + d. The twist
/// is 0 where brightness changes linearly. "Difference" means TilePixels::now minus
/// TilePixels::drawn. Values after the last tile are not initialised.
struct Blocks {
    using Values = std::array<std::array<float, kRowBlocks>, kSide>;
    using CellSums = std::array<std::array<std::int32_t, kRowCells>, kCells>;
    HWY_ALIGN Values light;               // mean luma of each block of the new frame
    HWY_ALIGN Values rough;               // half the absolute twist of the new frame's luma
    HWY_ALIGN Values lumaSum, lumaTwist;  // of each block of luma differences
    HWY_ALIGN CellSums redSum, blueSum;   // sum of the difference of red or blue over each cell
    // Each value is computed for all three colour channels of a cell, and the largest is stored.
    // farthest: |sum of the differences|. absolute: sum of the |differences|.
    HWY_ALIGN CellSums farthest, absolute;
    // Sum over blocks of (twist of the difference of red)^2, and the same for blue. A tile has four
    // sums for each of the two colours, one for each column of the tile's cells.
    HWY_ALIGN std::array<std::int32_t, kRowCells> redTwist, blueTwist;
};

#if HWY_TARGET == HWY_SCALAR

struct Block {
    int sum, twist, absolute;
};

Block BlockOf(int a, int b, int c, int d) {
    return {a + b + c + d, a - b - c + d, std::abs(a) + std::abs(b) + std::abs(c) + std::abs(d)};
}

float Weighed(float red, float green, float blue, float scale) {
    return kRed * scale * red + kGreen * scale * green + kBlue * scale * blue;
}

void ReadBlock(const TilePixels& pixels, int y, int x, Blocks& out) {
    std::array<Block, 3> difference{}, video{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::uint8_t* top = pixels.now[c][2 * y] + 2 * x;
        const std::uint8_t* bottom = pixels.now[c][2 * y + 1] + 2 * x;
        const std::uint8_t* oldTop = pixels.drawn[c][2 * y] + 2 * x;
        const std::uint8_t* oldBottom = pixels.drawn[c][2 * y + 1] + 2 * x;
        video[c] = BlockOf(top[0], top[1], bottom[0], bottom[1]);
        difference[c] = BlockOf(top[0] - oldTop[0], top[1] - oldTop[1], bottom[0] - oldBottom[0],
                                bottom[1] - oldBottom[1]);
    }
    const auto sums = [](const std::array<Block, 3>& b, float scale) {
        return Weighed(static_cast<float>(b[0].sum), static_cast<float>(b[1].sum),
                       static_cast<float>(b[2].sum), scale);
    };
    const auto twists = [](const std::array<Block, 3>& b, float scale) {
        return Weighed(static_cast<float>(b[0].twist), static_cast<float>(b[1].twist),
                       static_cast<float>(b[2].twist), scale);
    };
    out.light[y][x] = sums(video, 0.25F);
    out.rough[y][x] = std::abs(twists(video, 0.5F));
    out.lumaSum[y][x] = sums(difference, 1);
    out.lumaTwist[y][x] = twists(difference, 1);
    out.redTwist[x / 2] += difference[0].twist * difference[0].twist;
    out.blueTwist[x / 2] += difference[2].twist * difference[2].twist;
    out.redSum[y / 2][x / 2] += difference[0].sum;
    out.blueSum[y / 2][x / 2] += difference[2].sum;
}

void ReadCell(const TilePixels& pixels, int y, int x, Blocks& out) {
    for (std::size_t c = 0; c < 3; ++c) {
        int sum = 0, absolute = 0;
        for (int j = 4 * y; j < 4 * y + 4; ++j)
            for (int i = 4 * x; i < 4 * x + 4; ++i) {
                const int difference = pixels.now[c][j][i] - pixels.drawn[c][j][i];
                sum += difference;
                absolute += std::abs(difference);
            }
        out.farthest[y][x] = std::max(out.farthest[y][x], std::abs(sum));
        out.absolute[y][x] = std::max(out.absolute[y][x], absolute);
    }
}

void ReadBlocks(const TilePixels& pixels, Blocks& out) {
    out = {};
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide * pixels.tiles; ++x)
            ReadBlock(pixels, y, x, out);
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells * pixels.tiles; ++x)
            ReadCell(pixels, y, x, out);
}

#else

template <class D>
struct Block {
    using V = hn::Vec<D>;
    // This constructor is not defaulted, because a constructor that the compiler generates is not
    // compiled for this instruction set. With NEON's vectors, that is an error.
    HWY_INLINE Block() {}  // NOLINT(modernize-use-equals-default)
    HWY_INLINE Block(V s, V t, V a) : sum(s), twist(t), absolute(a) {}
    V sum, twist, absolute;
};

template <class D>
struct Quad {
    hn::Vec<D> a, b, c, d;
};

template <class D>
HWY_INLINE Quad<D> ReadQuad(D d, const std::uint8_t* top, const std::uint8_t* bottom) {
    // Each 16-bit lane holds two neighbouring pixels of a row, the left one in its low byte.
    const hn::Repartition<std::uint8_t, D> d8;
    const auto low = hn::Set(d, 0xFF);
    const hn::RebindToUnsigned<D> du;
    const auto upper = hn::BitCast(d, hn::LoadU(d8, top));
    const auto lower = hn::BitCast(d, hn::LoadU(d8, bottom));
    const auto high = [&](auto words) HWY_ATTR {
        return hn::BitCast(d, hn::ShiftRight<8>(hn::BitCast(du, words)));
    };
    return {hn::And(upper, low), high(upper), hn::And(lower, low), high(lower)};
}

template <class D>
HWY_INLINE Quad<D> Difference(const Quad<D>& now, const Quad<D>& drawn) {
    return {hn::Sub(now.a, drawn.a), hn::Sub(now.b, drawn.b), hn::Sub(now.c, drawn.c),
            hn::Sub(now.d, drawn.d)};
}

template <class D>
HWY_INLINE Block<D> BlockOf(const Quad<D>& q) {
    const auto along = hn::Add(q.a, q.d), across = hn::Add(q.b, q.c);
    return {hn::Add(along, across), hn::Sub(along, across),
            hn::Add(hn::Add(hn::Abs(q.a), hn::Abs(q.b)), hn::Add(hn::Abs(q.c), hn::Abs(q.d)))};
}

/// Computes luma from three colour channels, multiplies it by `scale` (a power of 2), and stores
/// it. Stores its absolute value instead if `absolute` is true.
template <class D>
HWY_INLINE void StoreLuma(D, float scale, hn::Vec<D> red, hn::Vec<D> green, hn::Vec<D> blue,
                          bool absolute, float* to) {
    const hn::Repartition<std::int32_t, D> di;
    const hn::RebindToFloat<decltype(di)> df;
    const hn::Half<D> half;
    const auto r = hn::Set(df, kRed * scale), g = hn::Set(df, kGreen * scale),
               b = hn::Set(df, kBlue * scale);
    const auto store = [&](auto reds, auto greens, auto blues, float* at) HWY_ATTR {
        const auto floats = [&](auto v)
                                HWY_ATTR { return hn::ConvertTo(df, hn::PromoteTo(di, v)); };
        auto sum = hn::Add(hn::Mul(r, floats(reds)), hn::Mul(g, floats(greens)));
        sum = hn::Add(sum, hn::Mul(b, floats(blues)));
        hn::StoreU(absolute ? hn::Abs(sum) : sum, df, at);
    };
    store(hn::LowerHalf(half, red), hn::LowerHalf(half, green), hn::LowerHalf(half, blue), to);
    store(hn::UpperHalf(half, red), hn::UpperHalf(half, green), hn::UpperHalf(half, blue),
          to + hn::Lanes(df));
}

template <class D>
HWY_INLINE auto PairSums(D d, hn::Vec<D> v) {
    const hn::Repartition<std::int32_t, D> di;
    static_cast<void>(d);
    const auto pairs = hn::BitCast(di, v);
    return hn::Add(hn::ShiftRight<16>(hn::ShiftLeft<16>(pairs)), hn::ShiftRight<16>(pairs));
}

template <class D>
HWY_INLINE void ReadColumn(D d, const TilePixels& pixels, int x, Blocks& out) {
    const hn::Repartition<std::int32_t, D> di;
    const auto zero = hn::Zero(di);
    auto red = zero, redRest = zero, blue = zero, blueRest = zero;
    for (int cellRow = 0; cellRow < kCells; ++cellRow) {
        auto farthest = zero, absolute = zero, redSum = zero, blueSum = zero;
        Block<D> video[2][3], difference[2][3];
        for (int channel = 0; channel < 3; ++channel) {
            const auto& now = pixels.now[channel];
            const auto& drawn = pixels.drawn[channel];
            for (int i = 0; i < 2; ++i) {
                const int y = 4 * cellRow + 2 * i;
                const Quad<D> quad = ReadQuad(d, now[y] + 2 * x, now[y + 1] + 2 * x);
                video[i][channel] = BlockOf<D>(quad);
                difference[i][channel] = BlockOf<D>(
                    Difference<D>(quad, ReadQuad(d, drawn[y] + 2 * x, drawn[y + 1] + 2 * x)));
            }
            const Block<D>&upper = difference[0][channel], &lower = difference[1][channel];
            const auto sums = PairSums(d, hn::Add(upper.sum, lower.sum));
            farthest = hn::Max(farthest, hn::Abs(sums));
            absolute = hn::Max(absolute, PairSums(d, hn::Add(upper.absolute, lower.absolute)));
            if (channel == 0) redSum = sums;
            if (channel == 2) blueSum = sums;
        }
        hn::StoreU(farthest, di, &out.farthest[cellRow][x / 2]);
        hn::StoreU(absolute, di, &out.absolute[cellRow][x / 2]);
        hn::StoreU(redSum, di, &out.redSum[cellRow][x / 2]);
        hn::StoreU(blueSum, di, &out.blueSum[cellRow][x / 2]);
        for (int i = 0; i < 2; ++i) {
            const int y = 2 * cellRow + i;
            const Block<D>&vr = video[i][0], &vg = video[i][1], &vb = video[i][2];
            const Block<D>&dr = difference[i][0], &dg = difference[i][1], &db = difference[i][2];
            StoreLuma(d, 0.25F, vr.sum, vg.sum, vb.sum, false, &out.light[y][x]);
            StoreLuma(d, 0.5F, vr.twist, vg.twist, vb.twist, true, &out.rough[y][x]);
            StoreLuma(d, 1, dr.sum, dg.sum, db.sum, false, &out.lumaSum[y][x]);
            StoreLuma(d, 1, dr.twist, dg.twist, db.twist, false, &out.lumaTwist[y][x]);
            red = hn::ReorderWidenMulAccumulate(di, dr.twist, dr.twist, red, redRest);
            blue = hn::ReorderWidenMulAccumulate(di, db.twist, db.twist, blue, blueRest);
        }
    }
    hn::StoreU(hn::Add(red, redRest), di, &out.redTwist[x / 2]);
    hn::StoreU(hn::Add(blue, blueRest), di, &out.blueTwist[x / 2]);
}

void ReadBlocks(const TilePixels& pixels, Blocks& out) {
    // First, vectors with the blocks of up to four tiles are processed, then vectors of one tile.
    const hn::CappedTag<std::int16_t, 4 * kSide> d;
    const hn::FixedTag<std::int16_t, kSide> tile;
    const int blocks = kSide * pixels.tiles, lanes = static_cast<int>(hn::Lanes(d));
    int x = 0;
    for (; x + lanes <= blocks; x += lanes)
        ReadColumn(d, pixels, x, out);
    for (; x < blocks; x += kSide)
        ReadColumn(tile, pixels, x, out);
}

#endif

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
