#include "pipeline/simd/paint_rows.h"

#include "pipeline/simd/view_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/paint_rows.cpp"

#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/display_values-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vectors have at most 8 lanes, because the rows of the grid (see PaintRow; two entries per pixel)
// are padded for only 8 pixels.
using D = hn::CappedTag<float, 8>;
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VU = hn::Vec<DU>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;

/// The four quarters of a pixel: upper left and right, lower left and right.
template <class T>
struct Four {
    T a, b, c, d;
};

struct Colour {
    V r, g, b;
};
struct Paint {
    Colour diffuse, facing;
};
HWY_INLINE Paint NoPaint() {
    const V zero = hn::Zero(D());
    return {{zero, zero, zero}, {zero, zero, zero}};
}

HWY_INLINE V F(float value) {
    return hn::Set(D(), value);
}
HWY_INLINE V LowHalf(VU word) {
    return hn::ConvertTo(D(), hn::BitCast(DI(), hn::And(word, hn::Set(DU(), 0xFFFFU))));
}
HWY_INLINE V HighHalf(VU word) {
    return hn::ConvertTo(D(), hn::BitCast(DI(), hn::ShiftRight<16>(word)));
}

template <class DT>
HWY_INLINE hn::Vec<DT> WordOf(DT d, const PaintTriangle* triangles, VU triangle, int word) {
    const auto* base = reinterpret_cast<const hn::TFromD<DT>*>(triangles) + word;
    return hn::GatherIndex(d, base, hn::BitCast(DI(), hn::ShiftLeft<4>(triangle)));
}

struct Plane {
    V first, perX, perY;
};
HWY_INLINE Plane PlaneOf(const PaintTriangle* triangles, VU triangle, int word) {
    return {WordOf(D(), triangles, triangle, word), WordOf(D(), triangles, triangle, word + 1),
            WordOf(D(), triangles, triangle, word + 2)};
}
HWY_INLINE V At(const Plane& plane, V x, V y) {
    return hn::MulAdd(y, plane.perY, hn::MulAdd(x, plane.perX, plane.first));
}

/// Returns an approximate binary logarithm of numbers >= 1. The error is below 0.01.
HWY_INLINE V Log2(V x) {
    const DU du;
    const VU bits = hn::BitCast(du, x);
    const V exponent = hn::ConvertTo(D(), hn::BitCast(DI(), hn::ShiftRight<23>(bits)));
    const V m =
        hn::BitCast(D(), hn::Or(hn::And(bits, hn::Set(du, 0x007FFFFFU)), hn::Set(du, 0x3F800000U)));
    // For 1 <= m < 2, log2(m) is about m - 1 + 0.34 (m - 1) (2 - m).
    const V low = hn::Sub(m, F(1));
    return hn::Add(hn::Sub(exponent, F(127)),
                   hn::MulAdd(hn::Mul(F(0.34F), low), hn::Sub(F(2), m), low));
}

struct Level {
    VI first, width, height;
    V across, down;
};
HWY_INLINE Level LevelAt(const PaintInput& in, VI level) {
    const DU du;
    const DI di;
    const auto* words = reinterpret_cast<const std::uint32_t*>(in.levels);
    const VI at = hn::Add(level, level);
    const VU size = hn::GatherIndex(du, words + 1, at);
    return {hn::BitCast(di, hn::GatherIndex(du, words, at)),
            hn::BitCast(di, hn::And(size, hn::Set(du, 0xFFFFU))),
            hn::BitCast(di, hn::ShiftRight<16>(size)), LowHalf(size), HighHalf(size)};
}

HWY_INLINE void AddSquares(VU word, V share, Colour& sum) {
    const VU bits = hn::Set(DU(), 0xFFU);
    const auto byte = [&](VU shifted) HWY_ATTR {
        return hn::ConvertTo(D(), hn::BitCast(DI(), hn::And(shifted, bits)));
    };
    const V r = byte(word), g = byte(hn::ShiftRight<8>(word)), b = byte(hn::ShiftRight<16>(word));
    sum.r = hn::MulAdd(hn::Mul(r, r), share, sum.r);
    sum.g = hn::MulAdd(hn::Mul(g, g), share, sum.g);
    sum.b = hn::MulAdd(hn::Mul(b, b), share, sum.b);
}

HWY_INLINE void AddTexel(const PaintInput& in, VI texel, V share, Paint& sum) {
    const DU du;
    const auto* words = reinterpret_cast<const std::uint32_t*>(in.texels);
    const VI at = hn::Add(texel, texel);
    AddSquares(hn::GatherIndex(du, words, at), share, sum.diffuse);
    AddSquares(hn::GatherIndex(du, words + 1, at), share, sum.facing);
}

struct Around {
    VI first, second;
    V beyond;
};
HWY_INLINE Around TexelsAround(V coordinate, VI side, V count) {
    const DI di;
    // NaN and huge coordinates become 0.
    coordinate = hn::IfThenElseZero(hn::Lt(hn::Abs(coordinate), F(1e6F)), coordinate);
    const V share = hn::Sub(coordinate, hn::Floor(coordinate));
    const V place = hn::MulSub(share, count, F(0.5F)), low = hn::Floor(place);
    const VI i = hn::ConvertTo(di, low), next = hn::Add(i, hn::Set(di, 1));
    return {hn::IfThenElse(hn::Lt(i, hn::Zero(di)), hn::Sub(side, hn::Set(di, 1)), i),
            hn::IfThenElse(hn::Lt(next, side), next, hn::Zero(di)), hn::Sub(place, low)};
}

HWY_INLINE void AddProbe(const PaintInput& in, const Level& level, V u, V v, float weight,
                         Paint& sum) {
    const Around x = TexelsAround(u, level.width, level.across);
    const Around y = TexelsAround(v, level.height, level.down);
    const VI upper = hn::Add(level.first, hn::Mul(y.first, level.width));
    const VI lower = hn::Add(level.first, hn::Mul(y.second, level.width));
    const V below = hn::Mul(y.beyond, F(weight)), above = hn::Sub(F(weight), below);
    const V belowRight = hn::Mul(below, x.beyond), aboveRight = hn::Mul(above, x.beyond);
    AddTexel(in, hn::Add(upper, x.first), hn::Sub(above, aboveRight), sum);
    AddTexel(in, hn::Add(upper, x.second), aboveRight, sum);
    AddTexel(in, hn::Add(lower, x.first), hn::Sub(below, belowRight), sum);
    AddTexel(in, hn::Add(lower, x.second), belowRight, sum);
}

/// The parallelogram that a part of a pixel covers in a texture, in texture coordinates: its middle
/// (u, v), and its sides (ux, vx) and (uy, vy).
struct Footprint {
    V u, v;
    V ux, vx, uy, vy;
};
HWY_INLINE Footprint FootprintAt(const PaintTriangle* triangles, VU triangle, V x, V y,
                                 float spread) {
    const Plane perZ = PlaneOf(triangles, triangle, 0);
    const Plane uPlane = PlaneOf(triangles, triangle, 3);
    const Plane vPlane = PlaneOf(triangles, triangle, 6);
    // The position (x, y) can lie outside the triangle. There, the 1 / z of the triangle's plane
    // can be 0 or negative.
    const V z = hn::Div(F(1), hn::Max(At(perZ, x, y), F(1e-6F)));
    const V u = hn::Mul(At(uPlane, x, y), z), v = hn::Mul(At(vPlane, x, y), z);
    const V step = hn::Mul(z, F(spread));
    return {u,
            v,
            hn::Mul(hn::NegMulAdd(u, perZ.perX, uPlane.perX), step),
            hn::Mul(hn::NegMulAdd(v, perZ.perX, vPlane.perX), step),
            hn::Mul(hn::NegMulAdd(u, perZ.perY, uPlane.perY), step),
            hn::Mul(hn::NegMulAdd(v, perZ.perY, vPlane.perY), step)};
}

/// Returns the paint at a position on the grid, averaged over `spread` grid pixels along each axis.
/// The average is computed from four bilinear look-ups (probes) at one pyramid level. If possible,
/// this is the level at which neighbouring probes are one to two texels apart. (Alternatives were
/// compared with the true mean over a pixel on the model "showpiece". One probe, interpolated
/// between two pyramid levels, is 4 dB worse. Four probes in a line along the footprint's longer
/// side are no better.)
HWY_INLINE Paint Sample(const PaintInput& in, VU triangle, V x, V y, float spread) {
    const D d;
    const DI di;
    const Footprint f = FootprintAt(in.triangles, triangle, x, y, 0.25F * spread);
    const VU size = WordOf(DU(), in.triangles, triangle, 9);
    const VU levels = WordOf(DU(), in.triangles, triangle, 10);
    const V texels = hn::Mul(LowHalf(size), HighHalf(size));
    const V area = hn::Mul(hn::Abs(hn::NegMulAdd(f.uy, f.vx, hn::Mul(f.ux, f.vy))), texels);
    // Area of the parallelogram whose corners are the positions of the four probes [texels]. Its
    // sides are twice as long as those of the footprint `f`, so its area is four times as large.
    const V apart = hn::Mul(area, F(4));
    const M finite = hn::Lt(apart, F(1e12F));
    const V held = hn::Max(hn::IfThenElse(finite, apart, F(1e12F)), F(1));
    const V last = hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<24>(levels)));
    const VI level = hn::ConvertTo(di, hn::Min(hn::Mul(F(0.5F), Log2(held)), last));
    const VI first = hn::BitCast(di, hn::And(levels, hn::Set(DU(), 0xFFFFFFU)));
    const Level at = LevelAt(in, hn::Add(first, level));
    Paint sum = NoPaint();
    const V rightU = hn::Add(f.u, f.ux), rightV = hn::Add(f.v, f.vx);
    const V leftU = hn::Sub(f.u, f.ux), leftV = hn::Sub(f.v, f.vx);
    AddProbe(in, at, hn::Add(rightU, f.uy), hn::Add(rightV, f.vy), 0.25F, sum);
    AddProbe(in, at, hn::Sub(rightU, f.uy), hn::Sub(rightV, f.vy), 0.25F, sum);
    AddProbe(in, at, hn::Add(leftU, f.uy), hn::Add(leftV, f.vy), 0.25F, sum);
    AddProbe(in, at, hn::Sub(leftU, f.uy), hn::Sub(leftV, f.vy), 0.25F, sum);
    return sum;
}

HWY_INLINE VU Byte(V level) {
    const V held = hn::Min(hn::Max(level, F(0)), F(255));
    return hn::BitCast(DU(), hn::ConvertTo(DI(), hn::Add(held, F(0.5F))));
}

/// Converts linear light to an sRGB byte. `linear` is 255^2 for the byte 255.
HWY_INLINE VU SrgbByte(V linear) {
    return Byte(SrgbLevel(D(), hn::Mul(linear, F(1.0F / 65025))));
}

/// The object that is painted in each pixel. It covers one or more of the pixel's quarters.
struct Shown {
    M any;
    VU triangle;
    V dx, dy;  ///< centre of the object's quarters, relative to the pixel's centre [grid px]
    Four<V> part;
    Four<VU> triangles;
};

HWY_INLINE Four<VU> ObjectsOf(const PaintRow& row, int x) {
    const DU du;
    Four<VU> s;
    hn::LoadInterleaved2(du, row.upper + 2L * x, s.a, s.b);
    hn::LoadInterleaved2(du, row.lower + 2L * x, s.c, s.d);
    const VU bits = hn::Set(du, 0xFFU), ofCatcher = hn::Set(du, kCatcherNumber);
    const auto object = [&](VU word) HWY_ATTR {
        const VU number = hn::And(word, bits);
        return hn::IfThenElseZero(hn::Ne(number, ofCatcher), number);
    };
    return {object(s.a), object(s.b), object(s.c), object(s.d)};
}

HWY_INLINE void Divide(const Four<VU>& s, const Four<VU>& t, VU number, VU count, Shown& out) {
    const D d;
    const DU du;
    const V part = hn::Div(F(1), hn::Max(hn::ConvertTo(d, hn::BitCast(DI(), count)), F(1)));
    const auto within = hn::RebindMask(du, out.any);
    out.triangle = hn::IfThenElseZero(within, out.triangle);
    const auto own = [&](VU n, VU index, V& share, VU& shown) HWY_ATTR {
        const auto mine = hn::And(hn::Eq(n, number), within);
        share = hn::IfThenElseZero(hn::RebindMask(d, mine), part);
        shown = hn::IfThenElse(mine, index, out.triangle);
    };
    own(s.a, t.a, out.part.a, out.triangles.a);
    own(s.b, t.b, out.part.b, out.triangles.b);
    own(s.c, t.c, out.part.c, out.triangles.c);
    own(s.d, t.d, out.part.d, out.triangles.d);
    const V right = hn::Add(out.part.b, out.part.d), left = hn::Add(out.part.a, out.part.c);
    const V below = hn::Add(out.part.c, out.part.d), above = hn::Add(out.part.a, out.part.b);
    out.dx = hn::Mul(F(0.5F), hn::Sub(right, left));
    out.dy = hn::Mul(F(0.5F), hn::Sub(below, above));
}

HWY_INLINE Shown Choose(const PaintRow& row, int x) {
    const D d;
    const DU du;
    const VU zero = hn::Zero(du), one = hn::Set(du, 1);
    const Four<VU> s = ObjectsOf(row, x);
    Four<VU> t;
    Shown out;
    out.any = hn::And(hn::RebindMask(d, hn::Ne(hn::Or(hn::Or(s.a, s.b), hn::Or(s.c, s.d)), zero)),
                      hn::FirstN(d, static_cast<std::size_t>(row.count - x)));
    if (hn::AllFalse(d, out.any)) return out;
    hn::LoadInterleaved2(du, row.upperIndices + 2L * x, t.a, t.b);
    hn::LoadInterleaved2(du, row.lowerIndices + 2L * x, t.c, t.d);
    const auto same = [&](VU p, VU q) HWY_ATTR { return hn::IfThenElseZero(hn::Eq(p, q), one); };
    const VU ab = same(s.a, s.b), ac = same(s.a, s.c), ad = same(s.a, s.d), bc = same(s.b, s.c),
             bd = same(s.b, s.d), cd = same(s.c, s.d);
    VU number = zero, most = zero;
    out.triangle = zero;
    const auto offer = [&](VU own, VU p, VU q, VU r, VU index) HWY_ATTR {
        const VU count = hn::Add(hn::Add(one, p), hn::Add(q, r));
        const auto more = hn::And(hn::Gt(count, most), hn::Ne(own, zero));
        most = hn::IfThenElse(more, count, most);
        number = hn::IfThenElse(more, own, number);
        out.triangle = hn::IfThenElse(more, index, out.triangle);
    };
    // mostOf() in rest_pixels.cpp offers the quarters in the same order, so that equal numbers of
    // quarters give the same object.
    offer(s.c, ac, bc, cd, t.c);
    offer(s.d, ad, bd, cd, t.d);
    offer(s.b, ab, bc, bd, t.b);
    offer(s.a, ab, ac, ad, t.a);
    Divide(s, t, number, most, out);
    return out;
}

HWY_INLINE M Differ(const PaintInput& in, const Shown& s) {
    const D d;
    const DU du;
    const VU differ =
        hn::Or(hn::Or(hn::Xor(s.triangles.a, s.triangle), hn::Xor(s.triangles.b, s.triangle)),
               hn::Or(hn::Xor(s.triangles.c, s.triangle), hn::Xor(s.triangles.d, s.triangle)));
    if (hn::AllTrue(du, hn::Eq(differ, hn::Zero(du)))) return hn::FirstN(d, 0);
    const auto materialOf = [&](VU triangle)
                                HWY_ATTR { return WordOf(du, in.triangles, triangle, 11); };
    const VU own = materialOf(s.triangle);
    const VU others = hn::Or(
        hn::Or(hn::Xor(materialOf(s.triangles.a), own), hn::Xor(materialOf(s.triangles.b), own)),
        hn::Or(hn::Xor(materialOf(s.triangles.c), own), hn::Xor(materialOf(s.triangles.d), own)));
    return hn::RebindMask(d, hn::Ne(others, hn::Zero(du)));
}

HWY_INLINE void AddShare(const Colour& colour, V share, Colour& sum) {
    sum.r = hn::MulAdd(colour.r, share, sum.r);
    sum.g = hn::MulAdd(colour.g, share, sum.g);
    sum.b = hn::MulAdd(colour.b, share, sum.b);
}

HWY_INLINE Paint SampleQuarters(const PaintInput& in, const Shown& s, V x, V y) {
    Paint sum = NoPaint();
    const auto add = [&](VU triangle, V share, float dx, float dy) HWY_ATTR {
        const Paint p = Sample(in, triangle, hn::Add(x, F(dx)), hn::Add(y, F(dy)), 1);
        AddShare(p.diffuse, share, sum.diffuse);
        AddShare(p.facing, share, sum.facing);
    };
    add(s.triangles.a, s.part.a, -0.5F, -0.5F);
    add(s.triangles.b, s.part.b, 0.5F, -0.5F);
    add(s.triangles.c, s.part.c, -0.5F, 0.5F);
    add(s.triangles.d, s.part.d, 0.5F, 0.5F);
    return sum;
}

HWY_INLINE VU ColourWord(M any, const Colour& c) {
    const VU rg = hn::Or(SrgbByte(c.r), hn::ShiftLeft<8>(SrgbByte(c.g)));
    return hn::IfThenElseZero(hn::RebindMask(DU(), any),
                              hn::Or(rg, hn::ShiftLeft<16>(SrgbByte(c.b))));
}

HWY_INLINE Colour Chosen(M yes, const Colour& a, const Colour& b) {
    return {hn::IfThenElse(yes, a.r, b.r), hn::IfThenElse(yes, a.g, b.g),
            hn::IfThenElse(yes, a.b, b.b)};
}

void PaintRowOf(const PaintRow& row, const PaintInput& in) {
    const D d;
    const DU du;
    const V y = F(2 * static_cast<float>(row.y) + 0.5F);
    for (int i = 0; i < row.count; i += static_cast<int>(hn::Lanes(d))) {
        const Shown s = Choose(row, i);
        auto* out = reinterpret_cast<std::uint32_t*>(row.out + i);
        if (hn::AllFalse(d, s.any)) {
            hn::StoreInterleaved2(hn::Zero(du), hn::Zero(du), du, out);
            continue;
        }
        const V pixel = hn::Iota(d, static_cast<float>(row.x + i));
        const V x = hn::MulAdd(F(2), pixel, F(0.5F));
        Paint p = Sample(in, s.triangle, hn::Add(x, s.dx), hn::Add(y, s.dy), 2);
        const M differ = Differ(in, s);
        if (!hn::AllFalse(d, differ)) {
            const Paint mixed = SampleQuarters(in, s, x, y);
            p = {Chosen(differ, mixed.diffuse, p.diffuse), Chosen(differ, mixed.facing, p.facing)};
        }
        hn::StoreInterleaved2(ColourWord(s.any, p.diffuse), ColourWord(s.any, p.facing), du, out);
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(PaintRowOf);

void paintRow(const PaintRow& row, const PaintInput& in) {
    HWY_DYNAMIC_DISPATCH(PaintRowOf)(row, in);
}

}  // namespace mfar::simd
#endif
