#include "pipeline/simd/layer_rows.h"

#include "pipeline/engine/params/occlusion.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/layer_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Body>
HWY_INLINE void Along(int count, const Body& body) {
    const hn::ScalableTag<float> d;
    const hn::CappedTag<float, 1> one;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int x = 0;
    for (; x + lanes <= count; x += lanes)
        body(d, x);
    for (; x < count; ++x)
        body(one, x);
}

/// Loads the entries of a row at the ascending columns `at`. If the layer is not larger than the
/// output, the columns are so close together that one vector of the row contains all entries. This
/// vector is then permuted. Otherwise the entries are gathered.
template <class D>
HWY_INLINE hn::Vec<D> Look(D d, const hn::TFromD<D>* row, const std::int32_t* at,
                           const LayerColumns& columns) {
    const hn::RebindToSigned<D> di;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    const int first = at[0];
    const auto column = hn::LoadU(di, at);
    if (at[lanes - 1] - first >= lanes) {
        // Columns beyond the loaded part of the row are clamped. Results for them are not used.
        const auto inside = hn::Min(column, hn::Set(di, columns.last));
        return hn::GatherIndex(d, row, hn::Sub(inside, hn::Set(di, columns.origin)));
    }
    const auto within = hn::IndicesFromVec(d, hn::Sub(column, hn::Set(di, first)));
    return hn::TableLookupLanes(hn::LoadU(d, row + (first - columns.origin)), within);
}

struct Depths {
    const float *above, *below;
    float share;
    const LayerColumns& columns;
    float* out;

    template <class D>
    HWY_INLINE void operator()(D d, int x) const {
        const hn::RebindToSigned<D> di;
        const auto one = hn::Set(d, 1.0F);
        const auto shares =
            hn::BitCast(di, hn::LoadU(hn::RebindToUnsigned<D>(), columns.share + x));
        const auto toRight = hn::Mul(hn::ConvertTo(d, hn::And(shares, hn::Set(di, 0x7FFF))),
                                     hn::Set(d, 1.0F / 32768));
        const auto toLeft = hn::Sub(one, toRight);
        const auto down = hn::Set(d, share), up = hn::Sub(one, down);
        auto best = hn::Zero(d), depth = hn::Zero(d);
        const auto consider = [&](const float* row, const std::int32_t* at, auto weight) HWY_ATTR {
            const auto z = Look(d, row, at + x, columns);
            const auto there = hn::And(hn::Gt(z, hn::Set(d, params::kLeastVirtualDepth)),
                                       hn::Lt(z, hn::Set(d, params::kMostVirtualDepth)));
            const auto better = hn::And(there, hn::Gt(weight, best));
            best = hn::IfThenElse(better, weight, best);
            depth = hn::IfThenElse(better, z, depth);
        };
        // If weights are equal, the first pixel wins. So the order must be that of textureGather,
        // which virtual_layer.glsl uses.
        consider(below, columns.left, hn::Mul(toLeft, down));
        consider(below, columns.right, hn::Mul(toRight, down));
        consider(above, columns.right, hn::Mul(toRight, up));
        consider(above, columns.left, hn::Mul(toLeft, up));
        hn::StoreU(depth, d, out + x);
    }
};

void EnlargeDepths(const float* above, const float* below, float share, const LayerColumns& columns,
                   int count, float* out) {
    Along(count, Depths{above, below, share, columns, out});
}

#if HWY_TARGET == HWY_SCALAR

std::uint32_t Between(std::uint32_t a, std::uint32_t b, std::uint32_t share) {
    const int from = static_cast<int>(a), to = static_cast<int>(b);
    return static_cast<std::uint32_t>(
        from + (((to - from) * static_cast<int>(share & 0x7FFFU) + (1 << 14)) >> 15));
}

std::uint32_t BetweenWords(std::uint32_t a, std::uint32_t b, std::uint32_t share) {
    return Between(a & 0xFFFFU, b & 0xFFFFU, share) | Between(a >> 16, b >> 16, share) << 16;
}

void BlendLayerRows(const std::uint32_t* above, const std::uint32_t* below, std::uint32_t share,
                    int count, const BlendedColours& out) {
    constexpr std::uint32_t kEven = 0x00FF00FF;
    for (int x = 0; x < count; ++x) {
        out.redBlue[x] = BetweenWords((above[x] & kEven) << 6, (below[x] & kEven) << 6, share);
        out.greenAlpha[x] =
            BetweenWords((above[x] >> 8 & kEven) << 6, (below[x] >> 8 & kEven) << 6, share);
    }
}

void EnlargeColours(const BlendedColours& part, const LayerColumns& columns, int count,
                    std::uint32_t* out) {
    for (int x = 0; x < count; ++x) {
        const int left = columns.left[x] - columns.origin,
                  right = columns.right[x] - columns.origin;
        const auto at = [&](const std::uint32_t* row) {
            const std::uint32_t sum = BetweenWords(row[left], row[right], columns.share[x]);
            return (sum + 0x00200020U) >> 6 & 0x00FF00FFU;
        };
        out[x] = at(part.redBlue) | at(part.greenAlpha) << 8;
    }
}

#else

using D32 = hn::ScalableTag<std::uint32_t>;
using D16 = hn::Repartition<std::uint16_t, D32>;
using V16 = hn::Vec<D16>;
using V32 = hn::Vec<D32>;

HWY_INLINE V16 Between(V16 a, V16 b, V16 share) {
    const hn::RebindToSigned<D16> di;
    const auto from = hn::BitCast(di, a);
    const auto step =
        hn::MulFixedPoint15(hn::Sub(hn::BitCast(di, b), from), hn::BitCast(di, share));
    return hn::BitCast(D16(), hn::Add(from, step));
}

void BlendLayerRows(const std::uint32_t* above, const std::uint32_t* below, std::uint32_t share,
                    int count, const BlendedColours& out) {
    const D32 d;
    const D16 d16;
    const auto even = hn::BitCast(d16, hn::Set(d, 0x00FF00FFU));
    const auto shares = hn::BitCast(d16, hn::Set(d, share));
    // The last vector may reach beyond the last entry; rows have kLayerSpare more entries.
    for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(d))) {
        const auto a = hn::BitCast(d16, hn::LoadU(d, above + x));
        const auto b = hn::BitCast(d16, hn::LoadU(d, below + x));
        const V16 redBlue =
            Between(hn::ShiftLeft<6>(hn::And(a, even)), hn::ShiftLeft<6>(hn::And(b, even)), shares);
        const V16 greenAlpha = Between(hn::ShiftLeft<6>(hn::ShiftRight<8>(a)),
                                       hn::ShiftLeft<6>(hn::ShiftRight<8>(b)), shares);
        hn::StoreU(hn::BitCast(d, redBlue), d, out.redBlue + x);
        hn::StoreU(hn::BitCast(d, greenAlpha), d, out.greenAlpha + x);
    }
}

void EnlargeColours(const BlendedColours& part, const LayerColumns& columns, int count,
                    std::uint32_t* out) {
    const D32 d;
    const D16 d16;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int x = 0; x < count; x += lanes) {
        const V16 share = hn::BitCast(d16, hn::LoadU(d, columns.share + x));
        const auto at = [&](const std::uint32_t* row) HWY_ATTR {
            const auto left = Look(d, row, columns.left + x, columns);
            const auto right = Look(d, row, columns.right + x, columns);
            const V16 sum = Between(hn::BitCast(d16, left), hn::BitCast(d16, right), share);
            return hn::ShiftRight<6>(hn::Add(sum, hn::Set(d16, 32)));
        };
        const V16 pixels = hn::Or(at(part.redBlue), hn::ShiftLeft<8>(at(part.greenAlpha)));
        hn::StoreU(hn::BitCast(d, pixels), d, out + x);
    }
}

#endif

std::uint32_t DividedBy255(std::uint32_t product) {
    product = std::min(product + 128, 65535U);
    return std::min(product + (product >> 8), 65535U) >> 8;
}

std::uint32_t BlendPixel(std::uint32_t colour, std::uint32_t visible, std::uint32_t under) {
    const std::uint32_t through = 255 - DividedBy255((colour >> 24) * visible);
    std::uint32_t out = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) {
        const std::uint32_t over = (colour >> shift & 255U) * visible;
        out |= DividedBy255(std::min(over + (under >> shift & 255U) * through, 65535U)) << shift;
    }
    return out;
}

#if HWY_TARGET != HWY_SCALAR

HWY_INLINE V16 DividedBy255(V16 product) {
    const V16 rounded = hn::SaturatedAdd(product, hn::Set(D16(), 128));
    return hn::ShiftRight<8>(hn::SaturatedAdd(rounded, hn::ShiftRight<8>(rounded)));
}

HWY_INLINE V16 BlendChannels(V16 colour, V16 visible, V16 under, V16 through) {
    return DividedBy255(hn::SaturatedAdd(hn::Mul(colour, visible), hn::Mul(under, through)));
}

HWY_INLINE int BlendVectors(const std::uint32_t* colours, const std::uint8_t* visibility, int count,
                            std::uint32_t* picture) {
    const D32 d;
    const D16 d16;
    const hn::Rebind<std::uint8_t, D32> d8;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const auto even = hn::BitCast(d16, hn::Set(d, 0x00FF00FFU));
    int x = 0;
    for (; x + lanes <= count; x += lanes) {
        const auto seen = hn::PromoteTo(d, hn::LoadU(d8, visibility + x));
        if (hn::AllTrue(d, hn::Eq(seen, hn::Zero(d)))) continue;
        const auto over = hn::LoadU(d, colours + x), under = hn::LoadU(d, picture + x);
        const V16 visible = hn::BitCast(d16, hn::Or(seen, hn::ShiftLeft<16>(seen)));
        const auto alpha = hn::ShiftRight<24>(over);
        const V16 alphas = hn::BitCast(d16, hn::Or(alpha, hn::ShiftLeft<16>(alpha)));
        const V16 through = hn::Sub(hn::Set(d16, 255), DividedBy255(hn::Mul(alphas, visible)));
        const V16 over16 = hn::BitCast(d16, over), under16 = hn::BitCast(d16, under);
        const V16 redBlue =
            BlendChannels(hn::And(over16, even), visible, hn::And(under16, even), through);
        const V16 greenAlpha =
            BlendChannels(hn::ShiftRight<8>(over16), visible, hn::ShiftRight<8>(under16), through);
        hn::StoreU(hn::BitCast(d, hn::Or(redBlue, hn::ShiftLeft<8>(greenAlpha))), d, picture + x);
    }
    return x;
}

#endif

void BlendRow(const std::uint32_t* colours, const std::uint8_t* visibility, int count,
              std::uint32_t* picture) {
    int x = 0;
#if HWY_TARGET != HWY_SCALAR
    x = BlendVectors(colours, visibility, count, picture);
#endif
    for (; x < count; ++x)
        if (visibility[x] != 0) picture[x] = BlendPixel(colours[x], visibility[x], picture[x]);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(BlendLayerRows);
HWY_EXPORT(EnlargeColours);
HWY_EXPORT(EnlargeDepths);
HWY_EXPORT(BlendRow);

std::uint32_t twiceInAWord(float share) {
    const auto bits = static_cast<std::uint32_t>(std::clamp(share * 32768, 0.0F, 32767.0F));
    return bits | bits << 16;
}

void blendLayerRows(const std::uint32_t* above, const std::uint32_t* below, float share, int count,
                    const BlendedColours& out) {
    HWY_DYNAMIC_DISPATCH(BlendLayerRows)(above, below, twiceInAWord(share), count, out);
}

void enlargeColours(const BlendedColours& part, const LayerColumns& columns, int count,
                    std::uint32_t* out) {
    HWY_DYNAMIC_DISPATCH(EnlargeColours)(part, columns, count, out);
}

void enlargeDepths(const float* above, const float* below, float share, const LayerColumns& columns,
                   int count, float* out) {
    HWY_DYNAMIC_DISPATCH(EnlargeDepths)(above, below, share, columns, count, out);
}

void blendRow(const std::uint32_t* colours, const std::uint8_t* visibility, int count,
              std::uint32_t* picture) {
    HWY_DYNAMIC_DISPATCH(BlendRow)(colours, visibility, count, picture);
}

}  // namespace mfar::simd
#endif
