// Loads the pixels of the still from which output pixels are interpolated: a block of 2x2 pixels
// (32 bits of StillPairs) for each output pixel. This header is included once per instruction set.
#include "pipeline/simd/detail_kernels.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#if defined(MFAR_SIMD_STILL_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_STILL_BLOCKS_INL_H
#undef MFAR_SIMD_STILL_BLOCKS_INL_H
#else
#define MFAR_SIMD_STILL_BLOCKS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

class StillBlocks {
    using I = hn::ScalableTag<std::int32_t>;
    using U = hn::ScalableTag<std::uint32_t>;

public:
    explicit StillBlocks(const StillPairs& still)
        : still_(still), pitch_(hn::Set(I(), static_cast<std::int32_t>(still.pitch))) {}

    HWY_INLINE hn::Vec<U> at(hn::Vec<I> x, hn::Vec<I> y) const {
        const std::int32_t left = hn::GetLane(x), top = hn::GetLane(y);
        hwy::Prefetch(still_.data + (top + kRowsAhead) * still_.pitch + left);
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
        // Neighbouring output pixels usually read blocks that are close together, in at most two
        // rows of the still. Then, loading a part of both rows and permuting it is faster than
        // loading the block of each lane.
        const I di;
        const U du;
        const std::int32_t begin = std::max(left - kBefore, 0);
        const std::int32_t bottom = hn::ExtractLane(y, hn::Lanes(di) - 1);
        const auto place = hn::BitCast(du, hn::Sub(x, hn::Set(di, begin)));
        const auto inTop = hn::RebindMask(du, hn::Eq(y, hn::Set(di, top))),
                   inBottom = hn::RebindMask(du, hn::Eq(y, hn::Set(di, bottom)));
        const auto found = hn::And(hn::Lt(place, hn::Set(du, kReach)), hn::Or(inTop, inBottom));
        if (hn::AllTrue(du, found))
            return hn::IfThenElse(inTop, permuted(top, begin, place),
                                  permuted(bottom, begin, place));
#endif
        return scattered(x, y);
    }

    /// Like at(), but faster if neighbouring lanes read blocks that are far apart. Loads the block
    /// of each lane on its own. On most targets, Highway's gathers would need addresses that are
    /// multiples of four bytes. On the others, gathers are hardly faster.
    HWY_INLINE hn::Vec<U> scattered(hn::Vec<I> x, hn::Vec<I> y) const {
        HWY_ALIGN std::int32_t at[hn::MaxLanes(I())];
        HWY_ALIGN std::uint32_t out[hn::MaxLanes(U())];
        hn::Store(hn::Add(hn::Mul(y, pitch_), x), I(), at);
        for (std::size_t i = 0; i < hn::Lanes(I()); ++i)
            std::memcpy(out + i, still_.data + at[i], sizeof(out[0]));
        return hn::Load(U(), out);
    }

private:
    /// Distance from a loaded row of the still to the row that is prefetched [rows]. The CPU does
    /// not predict which rows will be read, because the output is drawn in strips.
    static constexpr std::ptrdiff_t kRowsAhead = 2;

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    static constexpr std::int32_t kBefore = 4;  // columns loaded before the first lane's block
    static constexpr std::uint32_t kReach = 31;

    /// Returns the blocks at columns `begin` + `place` of a row of the still. They are selected
    /// from two loaded vectors, so each `place` must be less than kReach.
    HWY_INLINE hn::Vec<U> permuted(std::int32_t row, std::int32_t begin, hn::Vec<U> place) const {
        const U du;
        const hn::Repartition<std::uint16_t, U> d16;
        static_assert(hn::MaxLanes(d16) == kReach + 1);
        const std::uint16_t* from = still_.data + row * still_.pitch + begin;
        const auto even = hn::BitCast(du, hn::LoadU(d16, from));
        const auto odd = hn::BitCast(du, hn::LoadU(d16, from + 1));
        const auto indices = hn::IndicesFromVec(du, hn::ShiftRight<1>(place));
        return hn::IfThenElse(hn::TestBit(place, hn::Set(du, 1)),
                              hn::TableLookupLanes(odd, indices),
                              hn::TableLookupLanes(even, indices));
    }
#endif

    const StillPairs& still_;
    hn::Vec<I> pitch_;
};

/// Positions in the still: their pixels, and their fractional parts.
struct Positions {
    hn::Vec<hn::ScalableTag<std::int32_t>> x, y;
    hn::Vec<hn::ScalableTag<float>> fx, fy;
};

/// Splits positions, which are first limited to the picture.
HWY_INLINE Positions PositionsWithin(Size size, hn::Vec<hn::ScalableTag<float>> x,
                                     hn::Vec<hn::ScalableTag<float>> y) {
    const hn::ScalableTag<float> df;
    const hn::ScalableTag<std::int32_t> di;
    const auto within = [&](auto v, int count) HWY_ATTR {
        return hn::Min(hn::Max(v, hn::Zero(df)), hn::Set(df, static_cast<float>(count - 1)));
    };
    const auto px = within(x, size.width), py = within(y, size.height);
    const auto ix = hn::ConvertTo(di, px), iy = hn::ConvertTo(di, py);
    return {ix, iy, hn::Sub(px, hn::ConvertTo(df, ix)), hn::Sub(py, hn::ConvertTo(df, iy))};
}

/// Interpolates bilinearly between 2x2 pixels; the result is multiplied by 256. A lane of `texels`
/// holds the four pixels as bytes, from the highest to the lowest: lower right, upper right, lower
/// left, upper left.
HWY_INLINE hn::Vec<hn::ScalableTag<float>>
MeanOfFour(hn::Vec<hn::ScalableTag<std::uint32_t>> texels, const Positions& at) {
    const hn::ScalableTag<float> df;
    const hn::ScalableTag<std::int32_t> di;
    const hn::ScalableTag<std::uint32_t> du;
    // Each lane computes the left and the right column at once, in 16 bits each. This is enough for
    // the largest value, 255 * 256.
    const auto scaled = hn::NearestInt(hn::Mul(at.fy, hn::Set(df, 256.0F)));
    const auto lower = hn::BitCast(du, scaled);
    const auto upper = hn::Sub(hn::Set(du, 256), lower);
    const auto bytes = hn::Set(du, 0x00ff00ffU);
    const auto columns = hn::Add(hn::Mul(hn::And(texels, bytes), upper),
                                 hn::Mul(hn::And(hn::ShiftRight<8>(texels), bytes), lower));
    const auto left = hn::ConvertTo(df, hn::BitCast(di, hn::And(columns, hn::Set(du, 0xffffU))));
    const auto right = hn::ConvertTo(df, hn::BitCast(di, hn::ShiftRight<16>(columns)));
    return hn::MulAdd(hn::Sub(right, left), at.fx, left);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
