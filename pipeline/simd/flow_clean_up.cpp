#include "pipeline/simd/patch_flow.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/flow_clean_up.cpp"
#include <algorithm>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// A SIMD vector is at most as long as the margins of the flow fields. So a vector that begins in a
// row's last cells ends within the margin.
using Cells = hn::CappedTag<float, kFieldMargin>;
using Vec = hn::Vec<Cells>;

/// A plane fitted to one component of the flow around a cell: its value at the cell [px], and its
/// change from one cell to the next [px].
struct Plane {
    Vec value, dx, dy;
};

HWY_INLINE void order(Vec& a, Vec& b) {
    const Vec low = hn::Min(a, b);
    b = hn::Max(a, b);
    a = low;
}

/// Returns the median of 3x3 cells. Each column of three values is sorted first. The result is the
/// median of three values: the largest of the low values, the median of the middle values, and the
/// smallest of the high values.
HWY_INLINE Vec medianAt(const float* plane, std::ptrdiff_t pitch) {
    const Cells d;
    Vec low[3], middle[3], high[3];
    for (int i = 0; i < 3; ++i) {
        low[i] = hn::LoadU(d, plane - pitch + i - 1);
        middle[i] = hn::LoadU(d, plane + i - 1);
        high[i] = hn::LoadU(d, plane + pitch + i - 1);
        order(low[i], middle[i]);
        order(middle[i], high[i]);
        order(low[i], middle[i]);
    }
    order(middle[0], middle[1]);
    order(middle[1], middle[2]);
    order(middle[0], middle[1]);
    Vec least = hn::Max(hn::Max(low[0], low[1]), low[2]), centre = middle[1];
    Vec most = hn::Min(hn::Min(high[0], high[1]), high[2]);
    order(least, centre);
    order(centre, most);
    order(least, centre);
    return centre;
}

/// Weighted sums over a cell's neighbours in one row. For example, `wii` is the sum of w i i, `x`
/// is the sum of w x, and `xi` is the sum of w x i. In these products, w is a neighbour's weight, i
/// is its column offset, and (x, y) is the difference between its flow and the fitted planes.
struct RowSums {
    Vec w, wi, wii, x, xi, y, yi;
};

HWY_INLINE RowSums sumRow(const CleanUpStep& step, std::ptrdiff_t at, const Plane& x,
                          const Plane& y, float j, float reach) {
    const Cells d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F),
               least = hn::Set(d, params::kLeastPlaneWeight);
    const auto sharpness = hn::Set(d, 1 / (reach * reach)), down = hn::Set(d, j);
    const Vec aboutX = hn::MulAdd(down, x.dy, x.value), aboutY = hn::MulAdd(down, y.dy, y.value);
    RowSums s{zero, zero, zero, zero, zero, zero, zero};
    for (int i = -kCleanUpRadius; i <= kCleanUpRadius; ++i) {
        const auto along = hn::Set(d, static_cast<float>(i));
        const Vec dx = hn::Sub(hn::LoadU(d, step.in.x + at + i), hn::MulAdd(along, x.dx, aboutX));
        const Vec dy = hn::Sub(hn::LoadU(d, step.in.y + at + i), hn::MulAdd(along, y.dx, aboutY));
        const Vec squared = hn::MulAdd(dx, dx, hn::Mul(dy, dy));
        const Vec near = hn::Max(hn::NegMulAdd(squared, sharpness, one), zero);
        const Vec w = hn::Mul(near, hn::MulAdd(near, hn::LoadU(d, step.known + at + i), least));
        const Vec wi = hn::Mul(w, along);
        s.w = hn::Add(s.w, w);
        s.wi = hn::Add(s.wi, wi);
        s.wii = hn::MulAdd(wi, along, s.wii);
        s.x = hn::MulAdd(w, dx, s.x);
        s.xi = hn::MulAdd(wi, dx, s.xi);
        s.y = hn::MulAdd(w, dy, s.y);
        s.yi = hn::MulAdd(wi, dy, s.yi);
    }
    return s;
}

/// Weighted sums over a cell's neighbours in all rows, named as in RowSums. A neighbour also has
/// the row offset j.
struct PlaneSums {
    Vec w, wi, wj, wii, wij, wjj, x, xi, xj, y, yi, yj;
};

HWY_INLINE PlaneSums sumNeighbours(const CleanUpStep& step, std::ptrdiff_t at, const Plane& x,
                                   const Plane& y, float reach) {
    const Cells d;
    const Vec o = hn::Zero(d);
    PlaneSums s{o, o, o, o, o, o, o, o, o, o, o, o};
    for (int j = -kCleanUpRadius; j <= kCleanUpRadius; ++j) {
        const auto down = static_cast<float>(j);
        const RowSums r = sumRow(step, at + j * step.in.pitch, x, y, down, reach);
        const auto by = hn::Set(d, down);
        const Vec wj = hn::Mul(r.w, by);
        s.w = hn::Add(s.w, r.w);
        s.wi = hn::Add(s.wi, r.wi);
        s.wj = hn::Add(s.wj, wj);
        s.wii = hn::Add(s.wii, r.wii);
        s.wij = hn::MulAdd(r.wi, by, s.wij);
        s.wjj = hn::MulAdd(wj, by, s.wjj);
        s.x = hn::Add(s.x, r.x);
        s.xi = hn::Add(s.xi, r.xi);
        s.xj = hn::MulAdd(r.x, by, s.xj);
        s.y = hn::Add(s.y, r.y);
        s.yi = hn::Add(s.yi, r.yi);
        s.yj = hn::MulAdd(r.y, by, s.yj);
    }
    return s;
}

HWY_INLINE Vec crossed(Vec a, Vec b, Vec c, Vec d) {
    return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}

/// Fits the planes `x` and `y` again to the flow of the neighbours. A neighbour's weight depends on
/// its reliability and on the distance of its flow from the previous planes. So neighbours beyond a
/// depth edge have no influence.
HWY_INLINE void fitPlanes(const CleanUpStep& step, std::ptrdiff_t at, float reach, Plane& x,
                          Plane& y) {
    const Cells d;
    const PlaneSums s = sumNeighbours(step, at, x, y, reach);
    // The slopes are damped in the normal equations, because a single neighbour does not determine
    // them.
    const Vec damp = hn::MulAdd(hn::Set(d, params::kSlopeDampingPerWeight), s.w,
                                hn::Set(d, params::kSlopeDamping));
    const Vec ww = hn::Add(s.w, hn::Set(d, 1e-6F));
    const Vec ii = hn::Add(s.wii, damp), jj = hn::Add(s.wjj, damp);
    const Vec c00 = crossed(ii, jj, s.wij, s.wij), c01 = crossed(s.wj, s.wij, s.wi, jj);
    const Vec c02 = crossed(s.wi, s.wij, s.wj, ii), c11 = crossed(ww, jj, s.wj, s.wj);
    const Vec c12 = crossed(s.wi, s.wj, ww, s.wij), c22 = crossed(ww, ii, s.wi, s.wi);
    const Vec det = hn::MulAdd(ww, c00, hn::MulAdd(s.wi, c01, hn::Mul(s.wj, c02)));
    const auto solvable = hn::Gt(det, hn::Set(d, 1e-9F));
    const Vec scale = hn::IfThenElseZero(solvable, hn::Div(hn::Set(d, 1.0F), det));
    const auto move = [&](Plane& p, Vec u0, Vec ui, Vec uj) HWY_ATTR {
        const auto by = [&](Vec a, Vec b, Vec c) HWY_ATTR {
            return hn::MulAdd(a, u0, hn::MulAdd(b, ui, hn::Mul(c, uj)));
        };
        // If the equations have no solution, the planes stay unchanged. `scale` = 0 is not enough
        // for this: the sums can contain NaN, and 0 * NaN is NaN.
        const auto moved = [&](Vec v, Vec change) HWY_ATTR {
            return hn::IfThenElse(solvable, hn::MulAdd(scale, change, v), v);
        };
        p.value = moved(p.value, by(c00, c01, c02));
        p.dx = moved(p.dx, by(c01, c11, c12));
        p.dy = moved(p.dy, by(c02, c12, c22));
    };
    move(x, s.x, s.xi, s.xj);
    move(y, s.y, s.yi, s.yj);
}

}  // namespace

void CleanUpCells(const CleanUpStep& step, int row, int first, int end) {
    const Cells d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    const FlowPlanes& in = step.in;
    alignas(64) float rest[4 * kFieldMargin];
    for (int column = first; column < end; column += lanes) {
        const std::ptrdiff_t at = row * in.pitch + column;
        const Vec zero = hn::Zero(d);
        Plane x{medianAt(in.x + at, in.pitch), zero, zero};
        Plane y{medianAt(in.y + at, in.pitch), zero, zero};
        for (int i = 0; i < step.planeFits; ++i)
            fitPlanes(step, at, i == 0 ? params::kFirstPlaneReach : params::kPlaneReach, x, y);
        const Vec cost = hn::LoadU(d, in.cost + at), texture = hn::LoadU(d, in.texture + at);
        float* to = step.out + 4 * (static_cast<std::ptrdiff_t>(row) * in.columns + column);
        const int count = std::min(lanes, end - column);
        hn::StoreInterleaved4(x.value, y.value, cost, texture, d, count == lanes ? to : rest);
        if (count < lanes) std::copy_n(rest, 4 * count, to);
    }
}

void PrepareCleanUpRow(const FlowPlanes& field, float* known, int row) {
    const Cells d;
    const std::ptrdiff_t at = row * field.pitch;
    const auto one = hn::Set(d, 1.0F), two = hn::Set(d, 2.0F),
               half = hn::Set(d, params::kHalfTrusted);
    for (int c = 0; c < field.columns; c += static_cast<int>(hn::Lanes(d))) {
        const Vec texture = hn::LoadU(d, field.texture + at + c);
        const Vec fits = hn::NegMulAdd(two, hn::LoadU(d, field.cost + at + c), one);
        const Vec share = hn::Div(texture, hn::Add(texture, half));
        hn::StoreU(hn::Mul(share, hn::Max(fits, hn::Zero(d))), d, known + at + c);
    }
    for (float* plane : {field.x, field.y, known}) {
        std::fill_n(plane + at - kCleanUpRadius, kCleanUpRadius, plane[at]);
        std::fill_n(plane + at + field.columns, kCleanUpRadius, plane[at + field.columns - 1]);
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

void copyCells(const CleanUpStep& step, int row, int first, int end) {
    const FlowPlanes& in = step.in;
    float* to = step.out + 4 * (static_cast<std::ptrdiff_t>(row) * in.columns + first);
    for (std::ptrdiff_t at = row * in.pitch + first; at < row * in.pitch + end; ++at) {
        for (const float* plane : {in.x, in.y, in.cost, in.texture})
            *to++ = plane[at];
    }
}

HWY_EXPORT(CleanUpCells);
HWY_EXPORT(PrepareCleanUpRow);

void cleanUpCells(const CleanUpStep& step, int row, int first, int end) {
    HWY_DYNAMIC_DISPATCH(CleanUpCells)(step, row, first, end);
}

void prepareCleanUpRow(const FlowPlanes& field, float* known, int row) {
    HWY_DYNAMIC_DISPATCH(PrepareCleanUpRow)(field, known, row);
}

}  // namespace mfar::simd
#endif
