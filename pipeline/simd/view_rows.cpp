#include "pipeline/simd/view_rows.h"

#include "base/light_word.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/view_rows.cpp"

#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/display_values-inl.h"
#include "pipeline/simd/point_lens-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vectors have at most 8 lanes, because ViewRow::upper and ViewRow::lower (two words per pixel) are
// padded for only 8 pixels.
using D = hn::CappedTag<float, 8>;
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VU = hn::Vec<DU>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;

struct Four {
    VU a, b, c, d;
};

HWY_INLINE V DepthOf(VU word) {
    return hn::BitCast(D(), hn::And(word, hn::Set(DU(), 0xFFFFFF00U)));
}
HWY_INLINE M AsFloats(hn::Mask<DU> mask) {
    return hn::RebindMask(D(), mask);
}

/// True where all four words have the surface number `number` in their lowest byte.
HWY_INLINE M AllShow(const Four& s, VU number) {
    const VU differ = hn::Or(hn::Or(hn::Xor(s.a, number), hn::Xor(s.b, number)),
                             hn::Or(hn::Xor(s.c, number), hn::Xor(s.d, number)));
    const VU bits = hn::And(differ, hn::Set(DU(), 0xFFU));
    return AsFloats(hn::Eq(bits, hn::Zero(DU())));
}

/// True where each of the four words shows the shadow catcher or no surface.
HWY_INLINE M AllOfCatcher(const Four& s) {
    const DU du;
    const auto shows = [&](VU word) HWY_ATTR {
        const VU number = hn::And(word, hn::Set(du, 0xFFU));
        return hn::Or(hn::Eq(number, hn::Set(du, kCatcherNumber)), hn::Eq(word, hn::Zero(du)));
    };
    return AsFloats(hn::And(hn::And(shows(s.a), shows(s.b)), hn::And(shows(s.c), shows(s.d))));
}

/// True where all four words have about the depth `z`.
HWY_INLINE M AllClose(const Four& s, V z) {
    const V tolerance = hn::Mul(z, hn::Set(D(), kSameDepth));
    const auto isClose = [&](VU word) HWY_ATTR {
        return hn::Lt(hn::Abs(hn::Sub(DepthOf(word), z)), tolerance);
    };
    return hn::And(hn::And(isClose(s.a), isClose(s.b)), hn::And(isClose(s.c), isClose(s.d)));
}

/// Interpolates RGBA8 texels bilinearly, with weights in 1/256.
HWY_INLINE VU Blend(const Four& texels, const Four& weights) {
    const DU du;
    const VU even = hn::Set(du, 0x00FF00FFU), half = hn::Set(du, 0x00800080U);
    const auto sum = [&](auto channels) HWY_ATTR {
        const VU upper =
            hn::Add(hn::Mul(channels(texels.a), weights.a), hn::Mul(channels(texels.b), weights.b));
        const VU lower =
            hn::Add(hn::Mul(channels(texels.c), weights.c), hn::Mul(channels(texels.d), weights.d));
        return hn::Add(hn::Add(upper, lower), half);
    };
    const VU redBlue = sum([&](VU t) HWY_ATTR { return hn::And(t, even); });
    const VU greenAlpha = sum([&](VU t) HWY_ATTR { return hn::And(hn::ShiftRight<8>(t), even); });
    return hn::Or(hn::And(hn::ShiftRight<8>(redBlue), even), hn::AndNot(even, greenAlpha));
}

using Light = Triples<V>;

/// Returns the common factor 2^exponent of LightWords' channels, times the weight `share`.
HWY_INLINE V LightScale(VU words, VU share) {
    const DU du;
    const D d;
    constexpr std::uint32_t kOffset = 127 - kLightBias - kLightBits;
    const VU bits = hn::And(hn::ShiftRight<3 * kLightBits>(words), hn::Set(du, kLightExponent));
    const VU exponent = hn::Add(bits, hn::Set(du, kOffset));
    const V scale = hn::BitCast(d, hn::ShiftLeft<23>(exponent));
    return hn::Mul(scale,
                   hn::Mul(hn::ConvertTo(d, hn::BitCast(DI(), share)), hn::Set(d, 1.0F / 256)));
}

template <int kShift>
HWY_INLINE V LightChannel(VU words) {
    const VU bits = hn::And(hn::ShiftRight<kShift>(words), hn::Set(DU(), (1U << kLightBits) - 1));
    return hn::ConvertTo(D(), hn::BitCast(DI(), bits));
}

HWY_INLINE Light BlendLight(const Four& words, const Four& weights) {
    Light out{hn::Zero(D()), hn::Zero(D()), hn::Zero(D())};
    const auto add = [&](VU word, VU share) HWY_ATTR {
        const V scale = LightScale(word, share);
        out.x = hn::MulAdd(scale, LightChannel<0>(word), out.x);
        out.y = hn::MulAdd(scale, LightChannel<kLightBits>(word), out.y);
        out.z = hn::MulAdd(scale, LightChannel<2 * kLightBits>(word), out.z);
    };
    add(words.a, weights.a);
    add(words.b, weights.b);
    add(words.c, weights.c);
    add(words.d, weights.d);
    return out;
}

/// Interpolates UnpackedLight::veil bilinearly.
HWY_INLINE V BlendVeil(const Four& diffuse, const Four& specular, const Four& weights) {
    const auto veil = [&](VU d, VU s, VU weight) HWY_ATTR {
        const VU bits = hn::Or(hn::ShiftLeft<3>(hn::ShiftRight<kLightFreeBit>(d)),
                               hn::ShiftRight<kLightFreeBit>(s));
        return hn::Mul(bits, weight);
    };
    const VU sum = hn::Add(
        hn::Add(veil(diffuse.a, specular.a, weights.a), veil(diffuse.b, specular.b, weights.b)),
        hn::Add(veil(diffuse.c, specular.c, weights.c), veil(diffuse.d, specular.d, weights.d)));
    return hn::Mul(hn::ConvertTo(D(), hn::BitCast(DI(), sum)), hn::Set(D(), 1 / (256 * kMostVeil)));
}

struct PaintOf {
    VU diffuse, facing;
};

template <int kShift>
HWY_INLINE VU LitChannel(const PaintOf& paint, V diffuse, V specular, V veil) {
    const D d;
    const auto linear = [&](VU word) HWY_ATTR {
        const VU byte = hn::And(hn::ShiftRight<kShift>(word), hn::Set(DU(), 0xFFU));
        return LinearOf(d, hn::ConvertTo(d, hn::BitCast(DI(), byte)));
    };
    const V facing = linear(paint.facing);
    const V mirrored = hn::MulAdd(veil, hn::Sub(hn::Set(d, 1), facing), facing);
    const V sent = hn::MulAdd(linear(paint.diffuse), diffuse, hn::Mul(mirrored, specular));
    const VU byte = hn::BitCast(DU(), hn::NearestInt(SrgbLevel(d, sent)));
    return hn::ShiftLeft<kShift>(byte);
}

HWY_INLINE VU Lit(const PaintOf& paint, const Light& diffuse, const Light& specular, V veil) {
    const VU redGreen = hn::Or(LitChannel<0>(paint, diffuse.x, specular.x, veil),
                               LitChannel<8>(paint, diffuse.y, specular.y, veil));
    return hn::Or(hn::Or(redGreen, LitChannel<16>(paint, diffuse.z, specular.z, veil)),
                  hn::Set(DU(), 0xFF000000U));
}

/// Returns the weights [1/256] of the four texels around a position within a pixel.
HWY_INLINE Four WeightsOf(V x, V y) {
    const DU du;
    const D d;
    const V full = hn::Set(d, 256), half = hn::Set(d, 0.5F);
    const VU fx = hn::BitCast(du, hn::ConvertTo(DI(), hn::MulAdd(x, full, half)));
    const VU fy = hn::BitCast(du, hn::ConvertTo(DI(), hn::MulAdd(y, full, half)));
    const VU both = hn::ShiftRight<8>(hn::Add(hn::Mul(fx, fy), hn::Set(du, 128)));
    const VU right = hn::Sub(fx, both), below = hn::Sub(fy, both);
    return {hn::Sub(hn::Sub(hn::Set(du, 256), fx), below), right, below, both};
}

HWY_INLINE Four GatherFour(const std::uint32_t* from, VI at, int width) {
    const DU du;
    return {hn::GatherIndex(du, from, at), hn::GatherIndex(du, from + 1, at),
            hn::GatherIndex(du, from + width, at), hn::GatherIndex(du, from + width + 1, at)};
}

HWY_INLINE V PlaneDepth(const CatcherPlane& plane, V rayX, V rayY, float nearest) {
    const D d;
    V facing = hn::MulAdd(hn::Set(d, plane.x), rayX,
                          hn::MulAdd(hn::Set(d, plane.y), rayY, hn::Set(d, plane.z)));
    facing = hn::IfThenElse(hn::Eq(facing, hn::Zero(d)), hn::Set(d, 1), facing);
    const V z = hn::Div(hn::Set(d, plane.w), facing);
    const auto seen = hn::And(hn::Gt(z, hn::Set(d, nearest)), hn::Lt(z, hn::Set(d, 1e6F)));
    return hn::IfThenElseZero(seen, z);
}

HWY_INLINE Four QuartersOf(const ViewRow& row, int x) {
    Four s;
    hn::LoadInterleaved2(DU(), row.upper + 2L * x, s.a, s.b);
    hn::LoadInterleaved2(DU(), row.lower + 2L * x, s.c, s.d);
    return s;
}

struct Found {
    VU colour;
    V depth;
    VU state;
    M left;
};

/// The surface that each pixel of a vector shows, and the surface's position in the traced picture.
struct Asked {
    V z;  ///< z of the surface in the layer's camera [m]
    VU id;
    M ofCatcher;
    M empty;
    M asked;                       ///< true if the traced picture is read
    V thereZ;                      ///< z of the surface in the traced picture's camera [m]
    V pixelX, pixelY, lowX, lowY;  ///< position in the traced picture, exact and rounded down [px]
};

/// Transforms each point by the entry of `transforms` with the number of the point's surface.
HWY_INLINE Triples<V> TransformedByNumber(const PointTransform* transforms, VU number,
                                          const Triples<V>& p) {
    const D d;
    const VI first =
        hn::BitCast(DI(), hn::Mul(number, hn::Set(DU(), sizeof(PointTransform) / sizeof(float))));
    const auto row = [&](int i) HWY_ATTR {
        const float* from = &transforms->rows[i][0];
        const V xy = hn::MulAdd(hn::GatherIndex(d, from, first), p.x,
                                hn::Mul(hn::GatherIndex(d, from + 1, first), p.y));
        return hn::Add(xy, hn::MulAdd(hn::GatherIndex(d, from + 2, first), p.z,
                                      hn::GatherIndex(d, from + 3, first)));
    };
    return {row(0), row(1), row(2)};
}

HWY_INLINE Asked AskFor(const ViewLookUpInput& in, const Four& s, V rayX, V rayY) {
    const D d;
    const DU du;
    const V zero = hn::Zero(d);
    const VU ofFirst = hn::And(s.a, hn::Set(du, 0xFFU));
    const M whole = AllShow(s, ofFirst);
    const M open = hn::And(whole, AsFloats(hn::Eq(ofFirst, hn::Zero(du))));
    const V sum = hn::Add(hn::Add(DepthOf(s.a), DepthOf(s.b)), hn::Add(DepthOf(s.c), DepthOf(s.d)));
    const V onPlane = PlaneDepth(in.plane, rayX, rayY, in.lens.nearest);
    const V z = hn::IfThenElse(open, onPlane, hn::Mul(sum, hn::Set(d, 0.25F)));
    const M ofCatcher = hn::Or(open, AsFloats(hn::Eq(ofFirst, hn::Set(du, kCatcherNumber))));
    const VU id =
        hn::BitCast(du, hn::IfThenElse(ofCatcher, hn::BitCast(d, hn::Set(du, kCatcherNumber)),
                                       hn::BitCast(d, ofFirst)));
    const M empty = hn::And(open, hn::Eq(z, zero));

    const Triples<V> point{hn::Mul(z, rayX), hn::Mul(z, rayY), z};
    Triples<V> there = in.ofNumbers == nullptr ? Transformed(d, in.toTraced, point)
                                               : TransformedByNumber(in.ofNumbers, id, point);
    const M before = hn::And(hn::Gt(there.z, hn::Set(d, in.lens.nearest)),
                             hn::And(hn::Lt(there.z, hn::Set(d, 1e6F)), hn::Gt(z, zero)));
    there = {hn::IfThenElseZero(before, there.x), hn::IfThenElseZero(before, there.y),
             hn::IfThenElse(before, there.z, hn::Set(d, 1))};
    const Triples<V> pixel = PixelsOf(d, in.lens, there);
    const V lowX = hn::Floor(pixel.x), lowY = hn::Floor(pixel.y);
    const auto last = [&](int side) HWY_ATTR { return hn::Set(d, static_cast<float>(side - 2)); };
    const M inner = hn::And(hn::And(hn::Ge(lowX, zero), hn::Le(lowX, last(in.tracedSize.width))),
                            hn::And(hn::Ge(lowY, zero), hn::Le(lowY, last(in.tracedSize.height))));
    const M asked = hn::And(hn::And(inner, before), hn::AndNot(empty, whole));
    return {z, id, ofCatcher, empty, asked, there.z, pixel.x, pixel.y, lowX, lowY};
}

HWY_INLINE Four GatherLights(const std::uint32_t* from, VI at, int width) {
    const DU du;
    const VI word = hn::Add(at, at);
    return {hn::GatherIndex(du, from, word), hn::GatherIndex(du, from + 2, word),
            hn::GatherIndex(du, from + 2L * width, word),
            hn::GatherIndex(du, from + 2L * width + 2, word)};
}

HWY_INLINE void ReadReference(const ViewLookUpInput& in, const Asked& a, const PaintOf& paint,
                              Found& out) {
    const D d;
    const DU du;
    const V width = hn::Set(d, static_cast<float>(in.tracedSize.width));
    const VI row = hn::ConvertTo(DI(), hn::IfThenElseZero(a.asked, a.lowY));
    const VI at = hn::Add(hn::Mul(row, hn::ConvertTo(DI(), width)),
                          hn::ConvertTo(DI(), hn::IfThenElseZero(a.asked, a.lowX)));
    const Four t = GatherFour(in.packed, at, in.tracedSize.width);
    const M nothing = AsFloats(hn::Eq(hn::Or(hn::Or(t.a, t.b), hn::Or(t.c, t.d)), hn::Zero(du)));
    // All texels of a plane show the same surface, so their z need not be compared.
    const M known = in.plane.w != 0 ? AllOfCatcher(t) : nothing;
    const M shown =
        hn::Or(hn::And(AllClose(t, a.thereZ), AllShow(t, a.id)), hn::And(a.ofCatcher, known));
    const M plain = hn::And(a.asked, shown);
    const M coloured = hn::AndNot(nothing, plain);
    if (!hn::AllFalse(d, coloured)) {
        const Four weights = WeightsOf(hn::Sub(a.pixelX, a.lowX), hn::Sub(a.pixelY, a.lowY));
        VU found = hn::Zero(du);
        const M lit = in.lights == nullptr ? hn::FirstN(d, 0) : hn::AndNot(a.ofCatcher, coloured);
        if (!hn::AllFalse(d, hn::AndNot(lit, coloured)))
            found = Blend(GatherFour(in.colours, at, in.tracedSize.width), weights);
        if (!hn::AllFalse(d, lit)) {
            const Four diffuse = GatherLights(in.lights, at, in.tracedSize.width);
            const Four specular = GatherLights(in.lights + 1, at, in.tracedSize.width);
            const VU colour =
                Lit(paint, BlendLight(diffuse, weights), BlendLight(specular, weights),
                    BlendVeil(diffuse, specular, weights));
            found =
                hn::BitCast(du, hn::IfThenElse(lit, hn::BitCast(d, colour), hn::BitCast(d, found)));
        }
        out.colour = hn::BitCast(du, hn::IfThenElseZero(coloured, hn::BitCast(d, found)));
        // The light of a glowing object has a colour, but no alpha.
        const M visible = AsFloats(hn::Ne(out.colour, hn::Zero(du)));
        const V lifted = hn::IfThenElse(a.ofCatcher, hn::Mul(a.z, hn::Set(d, in.shownDepth)), a.z);
        out.depth = hn::IfThenElseZero(visible, lifted);
    }
    out.state = hn::BitCast(du, hn::IfThenElseZero(plain, hn::BitCast(d, hn::ShiftLeft<24>(a.id))));
    out.left = hn::Or(out.left, hn::AndNot(plain, a.asked));
}

HWY_INLINE Found LookUp(const ViewLookUpInput& in, const Four& s, V rayX, V rayY,
                        const PaintOf& paint) {
    const D d;
    const DU du;
    const Asked a = AskFor(in, s, rayX, rayY);
    Found out{hn::Zero(du), hn::Zero(d), hn::Zero(du),
              hn::AndNot(hn::Or(a.asked, a.empty), hn::FirstN(d, hn::Lanes(d)))};
    if (!hn::AllFalse(d, a.asked)) ReadReference(in, a, paint, out);
    return out;
}

int LookUpRow(const ViewRow& row, const ViewLookUpInput& in) {
    const D d;
    const DU du;
    const bool hasPlane = in.plane.w != 0;
    int left = 0;
    for (int x = 0; x < row.count; x += static_cast<int>(hn::Lanes(d))) {
        const Four s = QuartersOf(row, x);
        const VU any = hn::Or(hn::Or(s.a, s.b), hn::Or(s.c, s.d));
        if (!hasPlane && hn::AllTrue(du, hn::Eq(any, hn::Zero(du)))) {
            hn::StoreU(hn::Zero(du), du, row.colour + x);
            hn::StoreU(hn::Zero(du), du, row.state + x);
            hn::StoreU(hn::Zero(d), d, row.depth + x);
            continue;
        }
        PaintOf paint{hn::Zero(du), hn::Zero(du)};
        if (in.lights != nullptr)
            hn::LoadInterleaved2(du, reinterpret_cast<const std::uint32_t*>(row.paint + x),
                                 paint.diffuse, paint.facing);
        Found f = LookUp(in, s, hn::LoadU(d, row.rayX + x), hn::LoadU(d, row.rayY + x), paint);
        const M within = hn::FirstN(d, static_cast<std::size_t>(row.count - x));
        f.colour = hn::BitCast(du, hn::IfThenElseZero(within, hn::BitCast(d, f.colour)));
        f.state = hn::BitCast(du, hn::IfThenElseZero(within, hn::BitCast(d, f.state)));
        f.depth = hn::IfThenElseZero(within, f.depth);
        hn::StoreU(f.colour, du, row.colour + x);
        hn::StoreU(f.depth, d, row.depth + x);
        hn::StoreU(f.state, du, row.state + x);
        const auto some = hn::RebindMask(du, hn::And(f.left, within));
        if (hn::AllFalse(du, some)) continue;
        const VU index = hn::Iota(du, static_cast<std::uint32_t>(x));
        left += static_cast<int>(hn::CompressStore(index, some, du, row.left + left));
    }
    return left;
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(LookUpRow);

int lookUpRow(const ViewRow& row, const ViewLookUpInput& input) {
    return HWY_DYNAMIC_DISPATCH(LookUpRow)(row, input);
}

}  // namespace mfar::simd
#endif
