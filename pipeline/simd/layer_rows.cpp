#include "pipeline/simd/layer_rows.h"

#include <algorithm>

// Highway compiles what follows once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/layer_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whole vectors, then one lane at a time.
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

template <class D>
HWY_INLINE hn::Vec<D> Mix(hn::Vec<D> a, hn::Vec<D> b, hn::Vec<D> share) {
    return hn::MulAdd(hn::Sub(b, a), share, a);
}

struct Colours {
    const LayerRows& rows;
    const LayerColumns& columns;
    std::uint32_t* out;

    template <class D>
    HWY_INLINE void operator()(D d, int x) const {
        const hn::RebindToUnsigned<D> du;
        const hn::RebindToSigned<D> di;
        const auto left = hn::LoadU(di, columns.left + x), right = hn::LoadU(di, columns.right + x);
        const auto a = hn::GatherIndex(du, rows.colourAbove, left);
        const auto b = hn::GatherIndex(du, rows.colourAbove, right);
        const auto c = hn::GatherIndex(du, rows.colourBelow, left);
        const auto e = hn::GatherIndex(du, rows.colourBelow, right);
        const auto across = hn::LoadU(d, columns.share + x), down = hn::Set(d, rows.share);
        auto pixels = hn::Zero(du);
        for (int shift = 24; shift >= 0; shift -= 8) {
            const auto channel = [&](auto v) HWY_ATTR {
                const auto byte = hn::And(hn::ShiftRightSame(v, shift), hn::Set(du, 255));
                return hn::ConvertTo(d, hn::BitCast(di, byte));
            };
            const auto above = Mix<D>(channel(a), channel(b), across);
            const auto below = Mix<D>(channel(c), channel(e), across);
            const auto value = hn::Add(Mix<D>(above, below, down), hn::Set(d, 0.5F));
            pixels = hn::Or(hn::ShiftLeft<8>(pixels), hn::BitCast(du, hn::ConvertTo(di, value)));
        }
        hn::StoreU(pixels, du, out + x);
    }
};

void EnlargeColours(const LayerRows& rows, const LayerColumns& columns, int count,
                    std::uint32_t* out) {
    Along(count, Colours{rows, columns, out});
}

struct Depths {
    const LayerRows& rows;
    const LayerColumns& columns;
    float* out;

    template <class D>
    HWY_INLINE void operator()(D d, int x) const {
        const hn::RebindToSigned<D> di;
        const auto left = hn::LoadU(di, columns.left + x), right = hn::LoadU(di, columns.right + x);
        const auto one = hn::Set(d, 1.0F);
        const auto toRight = hn::LoadU(d, columns.share + x), toLeft = hn::Sub(one, toRight);
        const auto down = hn::Set(d, rows.share), up = hn::Sub(one, down);
        auto best = hn::Zero(d), depth = hn::Zero(d);
        const auto consider = [&](const float* row, auto column, auto weight) HWY_ATTR {
            const auto z = hn::GatherIndex(d, row, column);
            const auto there = hn::And(hn::Gt(z, hn::Set(d, 1e-4F)), hn::Lt(z, hn::Set(d, 1e6F)));
            const auto better = hn::And(there, hn::Gt(weight, best));
            best = hn::IfThenElse(better, weight, best);
            depth = hn::IfThenElse(better, z, depth);
        };
        // The first of equals counts: in the order of textureGather.
        consider(rows.depthBelow, left, hn::Mul(toLeft, down));
        consider(rows.depthBelow, right, hn::Mul(toRight, down));
        consider(rows.depthAbove, right, hn::Mul(toRight, up));
        consider(rows.depthAbove, left, hn::Mul(toLeft, up));
        hn::StoreU(depth, d, out + x);
    }
};

void EnlargeDepths(const LayerRows& rows, const LayerColumns& columns, int count, float* out) {
    Along(count, Depths{rows, columns, out});
}

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

using D32 = hn::ScalableTag<std::uint32_t>;
using D16 = hn::Repartition<std::uint16_t, D32>;
using V16 = hn::Vec<D16>;

HWY_INLINE V16 DividedBy255(V16 product) {
    const V16 rounded = hn::SaturatedAdd(product, hn::Set(D16(), 128));
    return hn::ShiftRight<8>(hn::SaturatedAdd(rounded, hn::ShiftRight<8>(rounded)));
}

/// Two of a pixel's channels in 16 bits each: over and under it.
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

HWY_EXPORT(EnlargeColours);
HWY_EXPORT(EnlargeDepths);
HWY_EXPORT(BlendRow);

void enlargeColours(const LayerRows& rows, const LayerColumns& columns, int count,
                    std::uint32_t* out) {
    HWY_DYNAMIC_DISPATCH(EnlargeColours)(rows, columns, count, out);
}

void enlargeDepths(const LayerRows& rows, const LayerColumns& columns, int count, float* out) {
    HWY_DYNAMIC_DISPATCH(EnlargeDepths)(rows, columns, count, out);
}

void blendRow(const std::uint32_t* colours, const std::uint8_t* visibility, int count,
              std::uint32_t* picture) {
    HWY_DYNAMIC_DISPATCH(BlendRow)(colours, visibility, count, picture);
}

}  // namespace mfar::simd
#endif
