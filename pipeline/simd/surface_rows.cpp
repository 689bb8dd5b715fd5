#include "pipeline/simd/surface_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/surface_rows.cpp"

#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/point_lens-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void ProjectCorners(const MeshRows& mesh, int count, const PointTransform& view,
                    const PointLens& lens, const CornerRows& out) {
    const hn::CappedTag<float, 16> d;
    const auto two = hn::Set(d, 2), one = hn::Set(d, 1);
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
        const Triples<hn::Vec<decltype(d)>> point{
            hn::LoadU(d, mesh.x + i), hn::LoadU(d, mesh.y + i), hn::LoadU(d, mesh.z + i)};
        const auto seen = Transformed(d, view, point);
        const auto pixel = PixelsOf(d, lens, seen);
        hn::StoreU(hn::MulAdd(two, pixel.x, one), d, out.x + i);
        hn::StoreU(hn::MulAdd(two, pixel.y, one), d, out.y + i);
        hn::StoreU(seen.z, d, out.z + i);
    }
}

/// Columns [first, last) of a row whose centres are inside a triangle and that are drawn
/// (RasterBand::where).
struct Columns {
    int first, last;
};
HWY_INLINE int FirstCentreFrom(float x, int least, int most) {
    const float centre = x - 0.5F, first = static_cast<float>(least);
    // The comparison is false for NaN, so NaN gives the first column.
    const float held = centre > first ? std::min(centre, static_cast<float>(most)) : first;
    return static_cast<int>(std::ceil(held));
}
HWY_INLINE Columns ColumnsAt(const RasterTriangle& t, int row, const PixelRect& where) {
    const float y = static_cast<float>(row) + 0.5F;
    const bool upper = y < t.middle;
    const float along = t.longX + (y - t.top) * t.longSlope;
    const float across =
        upper ? t.upperX + (y - t.top) * t.upperSlope : t.lowerX + (y - t.middle) * t.lowerSlope;
    const float left = t.longIsLeft ? along : across, right = t.longIsLeft ? across : along;
    return {FirstCentreFrom(left, where.x0, where.x1), FirstCentreFrom(right, where.x0, where.x1)};
}

void DrawTriangles(const RasterTriangle* triangles, std::size_t count, const RasterBand& band) {
    const hn::CappedTag<float, 8> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const auto iota = hn::Iota(d, 0);
    const auto half = hn::Set(du, 0x80), upper = hn::Set(du, 0xFFFFFF00U);
    for (std::size_t i = 0; i < count; ++i) {
        const RasterTriangle& t = triangles[i];
        const int last = std::min(t.lastRow, band.where.y1);
        for (int row = std::max(t.firstRow, band.where.y0); row < last; ++row) {
            const Columns columns = ColumnsAt(t, row, band.where);
            std::uint32_t *words = band.words[row], *indices = band.indices[row];
            const float first = t.perZ.first + static_cast<float>(row) * t.perZ.perY;
            for (int x = columns.first; x < columns.last; x += lanes) {
                const auto at = hn::Add(iota, hn::Set(d, static_cast<float>(x)));
                auto perZ = hn::Add(hn::Set(d, first), hn::Mul(at, hn::Set(d, t.perZ.perX)));
                perZ = hn::Min(hn::Max(perZ, hn::Set(d, t.leastPerZ)), hn::Set(d, t.mostPerZ));
                const auto z = hn::BitCast(du, hn::Div(hn::Set(d, 1), perZ));
                const auto word = hn::Or(hn::And(hn::Add(z, half), upper), hn::Set(du, t.word));
                const auto before = hn::LoadU(du, words + x);
                auto nearer = hn::Lt(word, before);
                const auto left = static_cast<std::size_t>(columns.last - x);
                if (left < static_cast<std::size_t>(lanes))
                    nearer = hn::And(nearer, hn::FirstN(du, left));
                if (hn::AllFalse(du, nearer)) continue;
                hn::StoreU(hn::IfThenElse(nearer, word, before), du, words + x);
                const auto other = hn::LoadU(du, indices + x);
                hn::StoreU(hn::IfThenElse(nearer, hn::Set(du, t.index), other), du, indices + x);
            }
        }
    }
}

struct TexelPair {
    int first, second;
    float share;  // of the second texel
};

HWY_INLINE TexelPair TexelsAbout(float coordinate, int side) {
    const float place = (coordinate - std::floor(coordinate)) * static_cast<float>(side) - 0.5F;
    const float below = std::floor(place);
    const int first = below >= 0 ? std::min(static_cast<int>(below), side - 1) : -1;
    return {first < 0 ? side - 1 : first, first + 1 >= side ? 0 : first + 1, place - below};
}

/// Alpha, interpolated between four texels as the path tracer does. The texture repeats.
HWY_INLINE float AlphaAt(const RasterMask& mask, float u, float v) {
    const TexelPair x = TexelsAbout(u, mask.size.width), y = TexelsAbout(v, mask.size.height);
    const auto between = [&](int row) {
        const std::uint8_t* texels =
            mask.rgba + 4 * static_cast<std::size_t>(row) * mask.size.width;
        const auto first = static_cast<float>(texels[4 * x.first + 3]);
        return first + x.share * (static_cast<float>(texels[4 * x.second + 3]) - first);
    };
    const float top = between(y.first);
    return (top + y.share * (between(y.second) - top)) / 255;
}

void DrawMasked(const MaskedTriangle* triangles, std::size_t count, const RasterBand& band) {
    const auto at = [](const RasterPlane& plane, int x, int y) {
        return plane.first + static_cast<float>(x) * plane.perX +
               static_cast<float>(y) * plane.perY;
    };
    for (std::size_t i = 0; i < count; ++i) {
        const MaskedTriangle& m = triangles[i];
        const RasterTriangle& t = m.triangle;
        const int last = std::min(t.lastRow, band.where.y1);
        for (int row = std::max(t.firstRow, band.where.y0); row < last; ++row) {
            const Columns columns = ColumnsAt(t, row, band.where);
            for (int x = columns.first; x < columns.last; ++x) {
                const float perZ = std::min(std::max(at(t.perZ, x, row), t.leastPerZ), t.mostPerZ);
                const float alpha = AlphaAt(m.mask, at(m.u, x, row) / perZ, at(m.v, x, row) / perZ);
                if (!(alpha >= m.mask.cutoff)) continue;
                const auto z = std::bit_cast<std::uint32_t>(1 / perZ);
                const std::uint32_t word = ((z + 0x80) & 0xFFFFFF00U) | t.word;
                if (word >= band.words[row][x]) continue;
                band.words[row][x] = word;
                band.indices[row][x] = t.index;
            }
        }
    }
}

void FinishBand(const RasterBand& band) {
    const hn::CappedTag<std::uint32_t, 16> d;
    const auto none = hn::Set(d, kNoSurface), bits = hn::Set(d, ~kBehindObjects);
    for (int y = band.where.y0; y < band.where.y1; ++y) {
        std::uint32_t* words = band.words[y];
        // Whole vectors can be written, because words after the band's columns are not used.
        for (int x = band.where.x0; x < band.where.x1; x += static_cast<int>(hn::Lanes(d))) {
            const auto word = hn::LoadU(d, words + x);
            hn::StoreU(hn::IfThenZeroElse(hn::Eq(word, none), hn::And(word, bits)), d, words + x);
        }
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(ProjectCorners);
HWY_EXPORT(DrawTriangles);
HWY_EXPORT(DrawMasked);
HWY_EXPORT(FinishBand);

namespace {

int firstRowFrom(float y) {
    return static_cast<int>(std::ceil(y - 0.5F));
}

}  // namespace

void projectCorners(const MeshRows& mesh, int count, const PointTransform& view,
                    const PointLens& lens, const CornerRows& out) {
    HWY_DYNAMIC_DISPATCH(ProjectCorners)(mesh, count, view, lens, out);
}

RasterPlane planeThrough(const RasterCorner (&c)[3], const float (&value)[3], float doubleArea) {
    const float x1 = c[1].x - c[0].x, y1 = c[1].y - c[0].y, x2 = c[2].x - c[0].x,
                y2 = c[2].y - c[0].y, v1 = value[1] - value[0], v2 = value[2] - value[0];
    RasterPlane out;
    out.perX = (v1 * y2 - v2 * y1) / doubleArea;
    out.perY = (v2 * x1 - v1 * x2) / doubleArea;
    out.first = value[0] + (0.5F - c[0].x) * out.perX + (0.5F - c[0].y) * out.perY;
    return out;
}

float doubleArea(const RasterCorner (&c)[3]) {
    return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
}

bool makeTriangle(const RasterCorner (&corners)[3], const RasterName& name, RasterTriangle& out) {
    const float area = doubleArea(corners);
    if (!(std::abs(area) > 0)) return false;
    const RasterCorner *a = &corners[0], *b = &corners[1], *c = &corners[2];
    if (b->y < a->y) std::swap(a, b);
    if (c->y < b->y) std::swap(b, c);
    if (b->y < a->y) std::swap(a, b);
    out.firstRow = firstRowFrom(a->y);
    out.lastRow = firstRowFrom(c->y);
    if (out.firstRow >= out.lastRow) return false;
    const auto slope = [](const RasterCorner* from, const RasterCorner* to) {
        return to->y > from->y ? (to->x - from->x) / (to->y - from->y) : 0.0F;
    };
    out.top = a->y;
    out.middle = b->y;
    out.bottom = c->y;
    out.longX = out.upperX = a->x;
    out.lowerX = b->x;
    out.longSlope = slope(a, c);
    out.upperSlope = slope(a, b);
    out.lowerSlope = slope(b, c);
    out.longIsLeft = (b->x - a->x) * (c->y - a->y) > (c->x - a->x) * (b->y - a->y);
    out.perZ = planeThrough(corners, {corners[0].perZ, corners[1].perZ, corners[2].perZ}, area);
    const auto [least, most] = std::minmax({corners[0].perZ, corners[1].perZ, corners[2].perZ});
    out.leastPerZ = least;
    out.mostPerZ = most;
    out.word = name.word;
    out.index = name.index;
    return true;
}

bool makeMasked(const RasterCorner (&corners)[3], const RasterName& name, const RasterMask& mask,
                MaskedTriangle& out) {
    if (!makeTriangle(corners, name, out.triangle)) return false;
    const float area = doubleArea(corners);
    out.u = planeThrough(corners, {corners[0].u, corners[1].u, corners[2].u}, area);
    out.v = planeThrough(corners, {corners[0].v, corners[1].v, corners[2].v}, area);
    out.mask = mask;
    return true;
}

void drawTriangles(std::span<const RasterTriangle> triangles, const RasterBand& band) {
    HWY_DYNAMIC_DISPATCH(DrawTriangles)(triangles.data(), triangles.size(), band);
}

void drawMasked(std::span<const MaskedTriangle> triangles, const RasterBand& band) {
    HWY_DYNAMIC_DISPATCH(DrawMasked)(triangles.data(), triangles.size(), band);
}

void clearBand(const RasterBand& band) {
    for (int y = band.where.y0; y < band.where.y1; ++y)
        std::fill(band.words[y] + band.where.x0, band.words[y] + band.where.x1, kNoSurface);
}

void finishBand(const RasterBand& band) {
    HWY_DYNAMIC_DISPATCH(FinishBand)(band);
}

}  // namespace mfar::simd
#endif
