#include "pipeline/simd/mirror_rows.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/mirror_rows.cpp"

#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/point_lens-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vectors have at most 8 lanes, because only 7 more entries follow a row (see mirror_rows.h).
using D = hn::CappedTag<float, 8>;
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VU = hn::Vec<DU>;
using VI = hn::Vec<DI>;
using V3 = Triples<V>;

// The visible share of the sun is measured only in pixels in which the mirrored sunlight exceeds
// this factor times the mirrored light of the sky.
constexpr float kLeastSun = 0.1F;
// The two words of MirrorParts have 6 free bits in total. They store the visible share of the sun,
// in steps of 1 / kMostSunShare.
constexpr float kMostSunShare = 63;

HWY_INLINE V F(float value) {
    return hn::Set(D(), value);
}
HWY_INLINE V Dot(const V3& a, const V3& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE V3 Unit(const V3& a) {
    const V scale = hn::Div(F(1), hn::Sqrt(hn::Max(Dot(a, a), F(1e-20F))));
    return {hn::Mul(a.x, scale), hn::Mul(a.y, scale), hn::Mul(a.z, scale)};
}
template <int kShift>
HWY_INLINE V ByteOf(VU word) {
    const VU byte = hn::And(hn::ShiftRight<kShift>(word), hn::Set(DU(), 0xFFU));
    return hn::ConvertTo(D(), hn::BitCast(DI(), byte));
}

HWY_INLINE V3 Unpacked(VU words) {
    const DU du;
    constexpr std::uint32_t kOffset = 127 - kLightBias - kLightBits;
    const VU bits = hn::And(hn::ShiftRight<3 * kLightBits>(words), hn::Set(du, kLightExponent));
    const V scale = hn::BitCast(D(), hn::ShiftLeft<23>(hn::Add(bits, hn::Set(du, kOffset))));
    return {hn::Mul(scale, ByteOf<0>(words)), hn::Mul(scale, ByteOf<kLightBits>(words)),
            hn::Mul(scale, ByteOf<2 * kLightBits>(words))};
}

/// Returns `light` as light words (see base/light_word.h) whose free bits are 0. The components of
/// `light` must not be negative.
HWY_INLINE VU Packed(const V3& light) {
    const DU du;
    const DI di;
    const V most = hn::Min(hn::Max(light.x, hn::Max(light.y, light.z)), F(kMostLight));
    // A value just below a power of two would be rounded to 256, which needs nine bits. The factor
    // gives such a value the next larger exponent.
    const VU bits = hn::BitCast(du, hn::Mul(most, F(1.003F)));
    const VI above = hn::Sub(hn::BitCast(di, hn::ShiftRight<23>(bits)), hn::Set(di, 126));
    const VI exponent = hn::Max(above, hn::Set(di, -kLightBias));
    const VI power = hn::Sub(hn::Set(di, 127 + kLightBits), exponent);
    const V scale = hn::BitCast(D(), hn::ShiftLeft<23>(power));
    const auto steps = [&](V value) HWY_ATTR {
        const V held = hn::Min(hn::Mul(hn::Min(value, F(kMostLight)), scale), F(255));
        return hn::BitCast(du, hn::NearestInt(held));
    };
    const VU colours = hn::Or(hn::Or(steps(light.x), hn::ShiftLeft<kLightBits>(steps(light.y))),
                              hn::ShiftLeft<2 * kLightBits>(steps(light.z)));
    const VU biased = hn::BitCast(du, hn::Add(exponent, hn::Set(di, kLightBias)));
    return hn::Or(colours, hn::ShiftLeft<3 * kLightBits>(biased));
}

HWY_INLINE V SignOf(V x) {
    return hn::IfThenElse(hn::Lt(x, hn::Zero(D())), F(-1), F(1));
}

HWY_INLINE void Fold(V z, V& x, V& y) {
    const auto lower = hn::Lt(z, hn::Zero(D()));
    const V u = hn::Mul(hn::Sub(F(1), hn::Abs(y)), SignOf(x));
    const V v = hn::Mul(hn::Sub(F(1), hn::Abs(x)), SignOf(y));
    x = hn::IfThenElse(lower, u, x);
    y = hn::IfThenElse(lower, v, y);
}

HWY_INLINE V3 NormalOf(VU word) {
    const DI di;
    const auto axis = [&](VU bits) HWY_ATTR {
        return hn::MulAdd(hn::ConvertTo(D(), hn::BitCast(di, bits)), F(2.0F / 65535), F(-1));
    };
    V x = axis(hn::And(word, hn::Set(DU(), 0xFFFFU))), y = axis(hn::ShiftRight<16>(word));
    const V z = hn::Sub(hn::Sub(F(1), hn::Abs(x)), hn::Abs(y));
    Fold(z, x, y);
    return Unit({x, y, z});
}

HWY_INLINE void AddShare(V3& sum, V share, const V3& light) {
    sum.x = hn::MulAdd(share, light.x, sum.x);
    sum.y = hn::MulAdd(share, light.y, sum.y);
    sum.z = hn::MulAdd(share, light.z, sum.z);
}

HWY_INLINE void AddTable(const MirrorInput& in, VI table, V x, V y, V weight, V3& sum) {
    const DI di;
    const VI at = hn::Add(table, table);
    const VI first = hn::GatherIndex(di, in.tables, at);
    const VI edge = hn::GatherIndex(di, in.tables + 1, at);
    const V last = hn::ConvertTo(D(), hn::Sub(edge, hn::Set(di, 1))), half = hn::Mul(F(0.5F), last);
    const auto place = [&](V p) HWY_ATTR {
        return hn::Min(hn::Max(hn::MulAdd(p, half, half), hn::Zero(D())), last);
    };
    const V u = place(x), v = place(y);
    const VI most = hn::Sub(edge, hn::Set(di, 2));
    const VI column = hn::Min(hn::ConvertTo(di, u), most),
             row = hn::Min(hn::ConvertTo(di, v), most);
    const V right = hn::Sub(u, hn::ConvertTo(D(), column)), left = hn::Sub(F(1), right);
    const V lower = hn::Mul(weight, hn::Sub(v, hn::ConvertTo(D(), row)));
    const V upper = hn::Sub(weight, lower);
    const VI above = hn::Add(first, hn::Add(hn::Mul(row, edge), column)),
             below = hn::Add(above, edge);
    const DU du;
    AddShare(sum, hn::Mul(upper, left), Unpacked(hn::GatherIndex(du, in.texels, above)));
    AddShare(sum, hn::Mul(upper, right), Unpacked(hn::GatherIndex(du, in.texels + 1, above)));
    AddShare(sum, hn::Mul(lower, left), Unpacked(hn::GatherIndex(du, in.texels, below)));
    AddShare(sum, hn::Mul(lower, right), Unpacked(hn::GatherIndex(du, in.texels + 1, below)));
}

HWY_INLINE V Fresnel(V facing, V cosine) {
    const V rest = hn::Sub(F(1), hn::Min(cosine, F(1))), square = hn::Mul(rest, rest);
    return hn::MulAdd(hn::Sub(F(1), facing), hn::Mul(hn::Mul(square, square), rest), facing);
}

/// Returns the sunlight that a surface with GGX roughness mirrors to the eye. The value is divided
/// by the sun's irradiance and by the surface's paint (see paint_rows.h).
HWY_INLINE V SunShare(const MirrorInput& in, const V3& normal, const V3& wo, V cosO, V facing,
                      V alpha) {
    const V3 sun{F(in.sun[0]), F(in.sun[1]), F(in.sun[2])};
    const V cosI = Dot(normal, sun);
    const V3 h = Unit({hn::Add(wo.x, sun.x), hn::Add(wo.y, sun.y), hn::Add(wo.z, sun.z)});
    const V cosN = hn::Min(Dot(normal, h), F(1)), cosH = hn::Max(Dot(wo, h), hn::Zero(D()));
    const V a2 = hn::Mul(alpha, alpha), rest = hn::Sub(F(1), a2);
    const V slope = hn::NegMulAdd(hn::Mul(cosN, cosN), rest, F(1));
    const V density = hn::Div(hn::Mul(a2, F(0.318309886F)), hn::Mul(slope, slope));
    const V held = hn::Max(cosI, hn::Zero(D()));
    const auto side = [&](V a, V b) HWY_ATTR {
        return hn::Mul(a, hn::Sqrt(hn::MulAdd(hn::Mul(b, b), rest, a2)));
    };
    const V seen = hn::Div(F(0.5F), hn::Max(hn::Add(side(held, cosO), side(cosO, held)), F(1e-6F)));
    const V paint = hn::Div(Fresnel(facing, cosH), hn::Max(Fresnel(facing, cosO), F(1e-3F)));
    return hn::Mul(hn::Mul(density, seen), hn::Mul(held, paint));
}

/// The light of sky and sun that pixels mirror to an eye if no object hides sky or sun. `sun` is
/// divided by the sun's irradiance.
struct FarParts {
    V3 sky;
    V sun;
};
HWY_INLINE FarParts Mirrored(const MirrorInput& in, const V3& normal, const V3& wo, VU look) {
    const D d;
    const V cosO = hn::Max(Dot(normal, wo), F(0.02F)), twice = hn::Add(cosO, cosO);
    const V3 towards{hn::MulSub(twice, normal.x, wo.x), hn::MulSub(twice, normal.y, wo.y),
                     hn::MulSub(twice, normal.z, wo.z)};
    const V sum = hn::Add(hn::Add(hn::Abs(towards.x), hn::Abs(towards.y)), hn::Abs(towards.z));
    const V scale = hn::Div(F(1), hn::Max(sum, F(1e-6F)));
    V x = hn::Mul(towards.x, scale), y = hn::Mul(towards.y, scale);
    Fold(towards.z, x, y);
    const VI roughness = hn::BitCast(DI(), hn::And(look, hn::Set(DU(), 0xFFU)));
    const VI table = hn::GatherIndex(DI(), in.tableOf, roughness);
    const V share = hn::GatherIndex(d, in.shareOf, roughness);
    V3 out{F(in.least), F(in.least), F(in.least)};
    AddTable(in, table, x, y, hn::Sub(F(1), share), out);
    if (!hn::AllFalse(d, hn::Gt(share, hn::Zero(d))))
        AddTable(in, hn::Add(table, hn::Set(DI(), 1)), x, y, share, out);
    const V full = hn::Mul(ByteOf<16>(look), F(in.exposure / 255));
    const V facing = hn::Mul(ByteOf<8>(look), F(1.0F / 255));
    const V alpha = hn::GatherIndex(d, in.alphaOf, roughness);
    return {{hn::Mul(full, out.x), hn::Mul(full, out.y), hn::Mul(full, out.z)},
            hn::Mul(F(in.exposure), SunShare(in, normal, wo, cosO, facing, alpha))};
}

template <class Body>
HWY_INLINE void ForGloss(const MirrorRow& row, const MirrorInput& in, const Body& body) {
    const D d;
    const DU du;
    for (int x = 0; x < row.count; x += static_cast<int>(hn::Lanes(d))) {
        const VU word = hn::LoadU(du, row.packed + x);
        const VU id = hn::And(word, hn::Set(du, 0xFFU));
        VU normal, look;
        hn::LoadInterleaved2(du, reinterpret_cast<const std::uint32_t*>(row.gloss + x), normal,
                             look);
        const auto known = hn::And(hn::And(hn::Ne(id, hn::Zero(du)), hn::Ne(look, hn::Zero(du))),
                                   hn::FirstN(du, static_cast<std::size_t>(row.count - x)));
        if (hn::AllFalse(du, known)) continue;
        const V z = hn::BitCast(d, hn::And(word, hn::Set(du, 0xFFFFFF00U)));
        const V rayX = hn::LoadU(d, row.rayX + x), rayY = hn::LoadU(d, row.rayY + x);
        const auto towardsEye = [&](int axis) HWY_ATTR {
            const V along = hn::MulAdd(rayX, F(in.axes[0][axis]),
                                       hn::MulAdd(rayY, F(in.axes[1][axis]), F(in.axes[2][axis])));
            return hn::NegMulAdd(z, along, F(in.eye[axis]));
        };
        const V3 wo = Unit({towardsEye(0), towardsEye(1), towardsEye(2)});
        look = hn::IfThenElseZero(known, look);
        body(x, Mirrored(in, NormalOf(normal), wo, look), known);
    }
}

/// The two words of an entry, for each lane. LoadPairs() and StorePairs() do not access entries
/// after the row's last one, because another thread may be changing the next row.
struct Pair {
    VU first, second;
};
HWY_INLINE Pair LoadPairs(const LightWords* from, int count) {
    const DU du;
    LightWords spare[8];
    if (count < static_cast<int>(hn::Lanes(du))) {
        std::copy_n(from, count, spare);
        from = spare;
    }
    Pair out;
    hn::LoadInterleaved2(du, reinterpret_cast<const std::uint32_t*>(from), out.first, out.second);
    return out;
}
template <class Words>
HWY_INLINE void StorePairs(const Pair& pair, int count, Words* to) {
    const DU du;
    Words spare[8];
    const bool fits = count >= static_cast<int>(hn::Lanes(du));
    auto* words = reinterpret_cast<std::uint32_t*>(fits ? to : spare);
    hn::StoreInterleaved2(pair.first, pair.second, du, words);
    if (!fits) std::copy_n(spare, count, to);
}

HWY_INLINE V Luminance(const V3& light) {
    return hn::MulAdd(F(0.2126F), light.x,
                      hn::MulAdd(F(0.7152F), light.y, hn::Mul(F(0.0722F), light.z)));
}
HWY_INLINE V ShareOf(V part, V whole) {
    const V share = hn::Div(part, hn::Max(whole, F(1e-9F)));
    return hn::Min(hn::Max(share, hn::Zero(D())), F(1));
}
HWY_INLINE V3 Sunlight(const MirrorInput& in, V share) {
    return {hn::Mul(share, F(in.irradiance[0])), hn::Mul(share, F(in.irradiance[1])),
            hn::Mul(share, F(in.irradiance[2]))};
}

void SplitMirrored(const MirrorRow& row, const MirrorInput& in, const LightWords* light,
                   MirrorParts* out) {
    const DU du;
    ForGloss(row, in, [&](int x, const FarParts& far, auto known) HWY_ATTR {
        const VU specular = LoadPairs(light + x, row.count - x).second;
        const V3 all = Unpacked(specular), sun = Sunlight(in, far.sun);
        const V ofSky = Luminance(far.sky), ofSun = Luminance(sun), ofAll = Luminance(all);
        // If a pixel mirrors little sunlight, sky and sun get the same share.
        const auto bright = hn::Gt(ofSun, hn::Mul(F(kLeastSun), ofSky));
        const auto shareOf = [&](V part, V sky, V sunPart) HWY_ATTR {
            return ShareOf(part, hn::Add(sky, hn::IfThenZeroElse(bright, sunPart)));
        };
        const V3 share{shareOf(all.x, far.sky.x, sun.x), shareOf(all.y, far.sky.y, sun.y),
                       shareOf(all.z, far.sky.z, sun.z)};
        const V sunShare =
            hn::IfThenElse(bright, ShareOf(hn::Sub(ofAll, ofSky), ofSun), Luminance(share));
        const auto rest = [&](V part, V sky, V sunPart) HWY_ATTR {
            return hn::Max(hn::Sub(part, hn::MulAdd(sunShare, sunPart, sky)), hn::Zero(D()));
        };
        const V3 rests{rest(all.x, far.sky.x, sun.x), rest(all.y, far.sky.y, sun.y),
                       rest(all.z, far.sky.z, sun.z)};
        const VU bits = hn::BitCast(du, hn::NearestInt(hn::Mul(sunShare, F(kMostSunShare))));
        const VU high = hn::ShiftLeft<kLightFreeBit>(hn::ShiftRight<3>(bits));
        const VU low = hn::ShiftLeft<kLightFreeBit>(hn::And(bits, hn::Set(du, 7)));
        StorePairs({hn::IfThenElseZero(known, hn::Or(Packed(share), high)),
                    hn::IfThenElseZero(known, hn::Or(Packed(rests), low))},
                   row.count - x, out + x);
    });
}

void JoinMirrored(const MirrorRow& row, const MirrorInput& in, const MirrorParts* parts,
                  LightWords* light) {
    const DU du;
    ForGloss(row, in, [&](int x, const FarParts& far, auto known) HWY_ATTR {
        VU share, rest;
        const auto [diffuse, specular] = LoadPairs(light + x, row.count - x);
        hn::LoadInterleaved2(du, reinterpret_cast<const std::uint32_t*>(parts + x), share, rest);
        const VU bits = hn::Or(hn::ShiftLeft<3>(hn::ShiftRight<kLightFreeBit>(share)),
                               hn::ShiftRight<kLightFreeBit>(rest));
        const V sunShare =
            hn::Mul(hn::ConvertTo(D(), hn::BitCast(DI(), bits)), F(1 / kMostSunShare));
        const V3 shares = Unpacked(share), sun = Sunlight(in, hn::Mul(sunShare, far.sun));
        V3 sum = Unpacked(rest);
        sum = {hn::MulAdd(shares.x, far.sky.x, hn::Add(sum.x, sun.x)),
               hn::MulAdd(shares.y, far.sky.y, hn::Add(sum.y, sun.y)),
               hn::MulAdd(shares.z, far.sky.z, hn::Add(sum.z, sun.z))};
        const VU veil = hn::ShiftLeft<kLightFreeBit>(hn::ShiftRight<kLightFreeBit>(specular));
        StorePairs({diffuse, hn::IfThenElse(known, hn::Or(Packed(sum), veil), specular)},
                   row.count - x, light + x);
    });
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(SplitMirrored);
HWY_EXPORT(JoinMirrored);

void splitMirrored(const MirrorRow& row, const MirrorInput& input, const LightWords* light,
                   MirrorParts* out) {
    HWY_DYNAMIC_DISPATCH(SplitMirrored)(row, input, light, out);
}

void joinMirrored(const MirrorRow& row, const MirrorInput& input, const MirrorParts* parts,
                  LightWords* light) {
    HWY_DYNAMIC_DISPATCH(JoinMirrored)(row, input, parts, light);
}

}  // namespace mfar::simd
#endif
