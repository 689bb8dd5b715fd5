#include "pipeline/simd/patch_flow.h"

// Highway compiles what follows once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/patch_search.cpp"
// clang-format off: in this order alone
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "pipeline/simd/patch_inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {

constexpr int kMostRadius = 40;
constexpr std::size_t kMostSide = 2 * kMostRadius + 1, kSideRoom = kMostSide + 15;

/// The vector of a cell that fits best so far.
struct Search {
    Vector2 best{1e9F, 1e9F};
    Match found;

    HWY_INLINE bool tries(Vector2 u) const { return !(squaredLength(u - best) < kSameCandidate); }
    HWY_INLINE bool take(Vector2 u, const Match& m) {
        if (!(m.cost < found.cost)) return false;
        found = m;
        best = u;
        return true;
    }
};

HWY_INLINE void refine(const Template& t, const PatchPicture& to, int column, int row, int steps,
                       Search& search) {
    for (int k = 0; k < steps; ++k) {
        const Vector2 s = stepOf(t, search.found.descent);
        if (!(squaredLength(s) > kShortestStep)) return;
        const Vector2 u = search.best + s;
        if (!search.take(u, compare(t, to, column, row, u))) return;
    }
}

HWY_INLINE Vector2 vectorOf(const FlowPlanes& field, int column, int row) {
    const std::ptrdiff_t at =
        std::clamp(row, 0, field.rows - 1) * field.pitch + std::clamp(column, 0, field.columns - 1);
    return {field.x[at], field.y[at]};
}

/// Sums of patches at whole pixels, a row of displacements at once.
struct WholeSums {
    alignas(64) float b[kSideRoom], bb[kSideRoom], ab[kSideRoom], cost[kSideRoom];
};

HWY_INLINE void sumWhole(const Template& t, const PatchRows& rows, std::size_t at, WholeSums& out) {
    const Row16 d16;
    const auto middle = hn::Set(d16, 128);
    ProductSum bb, ab, b;
    for (int c = 0; c < kPatch; c += kRowLanes) {
        auto columns = hn::Zero(d16);
        for (int r = 0; r < kPatch; ++r) {
            const auto v = hn::Sub(loadPixels(rows[r] + c), middle);
            columns = hn::Add(columns, v);
            bb.add(v, v);
            ab.add(v, hn::Load(d16, t.pixels + kPatch * r + c));
        }
        b.add(columns, hn::Set(d16, 1));
    }
    float sums[4];
    sumLanes(b.total(), bb.total(), ab.total(), ab.total(), sums);
    out.b[at] = sums[0];
    out.bb[at] = sums[1];
    out.ab[at] = sums[2];
}

/// matchOf()'s cost of each of `count` displacements.
HWY_INLINE void costsOf(const Template& t, std::size_t count, WholeSums& sums) {
    const hn::CappedTag<float, 16> d;
    const auto mean = hn::Set(d, t.mean), variance = hn::Set(d, t.variance);
    const auto noise = hn::Set(d, kNoise), two = hn::Set(d, 2.0F);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto b = hn::Load(d, sums.b + i);
        const auto squares = hn::Mul(b, hn::Mul(b, hn::Set(d, 1 / kPixels)));
        const auto varianceB = hn::Max(hn::Sub(hn::Load(d, sums.bb + i), squares), hn::Zero(d));
        const auto covariance = hn::Sub(hn::Load(d, sums.ab + i), hn::Mul(mean, b));
        const auto gain = hn::Sqrt(hn::Div(hn::Add(variance, noise), hn::Add(varianceB, noise)));
        const auto energy = hn::Add(variance, hn::Mul(hn::Mul(gain, gain), varianceB));
        const auto off = hn::Sub(energy, hn::Mul(two, hn::Mul(gain, covariance)));
        hn::Store(hn::Div(hn::Max(off, hn::Zero(d)), hn::Add(energy, noise)), d, sums.cost + i);
    }
}

/// Tries all displacements of a row; the first of the best is taken.
HWY_INLINE void searchWholeRow(const Template& t, const PatchPicture& to, int column, int row,
                               int radius, int dy, int firstDx, WholeSums& sums, Search& search) {
    const int y = std::clamp(kCellSize * row - 2 + dy, -7, to.height - 2);
    const auto count = static_cast<std::size_t>(radius - firstDx + 1);
    for (std::size_t i = 0; i < count; ++i) {
        const int dx = firstDx + static_cast<int>(i);
        const int x = std::clamp(kCellSize * column - 2 + dx, -7, to.width - 2);
        sumWhole(t, PatchRows(to, x, y, kPatch, kPatch), i, sums);
    }
    costsOf(t, count, sums);
    for (std::size_t i = 0; i < count; ++i) {
        const Vector2 u{static_cast<float>(firstDx) + static_cast<float>(i),
                        static_cast<float>(dy)};
        if (sums.cost[i] < search.found.cost && search.tries(u))
            search.take(u, {sums.cost[i], {0, 0}});
    }
}

/// The square of displacements, from no motion on row by row around: it wins where nothing tells.
HWY_INLINE void searchWhole(const Template& t, const PatchPicture& to, int column, int row,
                            int radius, Search& search) {
    WholeSums sums{};
    const Search before = search;
    searchWholeRow(t, to, column, row, radius, 0, 0, sums, search);
    for (int dy = 1; dy <= radius; ++dy)
        searchWholeRow(t, to, column, row, radius, dy, -radius, sums, search);
    for (int dy = -radius; dy < 0; ++dy)
        searchWholeRow(t, to, column, row, radius, dy, -radius, sums, search);
    searchWholeRow(t, to, column, row, -1, 0, -radius, sums, search);
    if (search.found.cost < before.found.cost)
        search.found.descent = compare(t, to, column, row, search.best).descent;
}

HWY_INLINE Search searchCell(const SearchStep& step, const Template& t, int column, int row) {
    Search search;
    const auto attempt = [&](Vector2 u) HWY_ATTR {
        if (search.tries(u)) search.take(u, compare(t, step.to, column, row, u));
    };
    if (step.prior.x != nullptr) {
        const PriorField& p = step.prior;
        const auto c = static_cast<int>((static_cast<float>(column) + 0.5F) * p.columnsPerCell);
        const auto r = static_cast<int>((static_cast<float>(row) + 0.5F) * p.rowsPerCell);
        const std::ptrdiff_t at = r * p.pitch + c * p.step;
        attempt({p.scale * p.x[at], p.scale * p.y[at]});
    }
    if (step.coarser.rows == 0) {
        searchWhole(t, step.to, column, row, std::min(step.radius, kMostRadius), search);
    } else {
        const int towardsX = (column & 1) * 2 - 1, towardsY = (row & 1) * 2 - 1;
        for (int k = 0; k < step.candidates; ++k)
            attempt(2.0F * vectorOf(step.coarser, (column >> 1) + (k & 1) * towardsX,
                                    (row >> 1) + (k >> 1) * towardsY));
    }
    refine(t, step.to, column, row, step.steps, search);
    return search;
}

}  // namespace

void SearchCells(const SearchStep& step, int row, int first, int end) {
    Template t;
    for (int column = first; column < end; ++column) {
        loadTemplate(step.from, column, row, t);
        const Search s = searchCell(step, t, column, row);
        put(step.out, column, row, s.best, s.found.cost, t.variance);
    }
}

void SearchListedCells(const ListedStep& step, int row, int first, int end) {
    // The z-test says nothing about what moves by itself: its cells are trusted by their cost, from
    // wholly to not at all (error = alpha of eq. 2).
    constexpr float kGoodCost = 0.1F, kErrorPerCost = 5.0F;
    constexpr float kOnLine = 1.0F;  // [px]
    // A cell leaves its line only for a cost this much lower: among many vectors one fits noise by
    // chance.
    constexpr float kClearlyLess = 0.5F;
    const FlowPlanes& out = step.search.out;
    Template t;
    for (int column = first; column < end; ++column) {
        loadTemplate(step.search.from, column, row, t);
        const Search s = searchCell(step.search, t, column, row);
        const std::ptrdiff_t at = row * out.pitch + column;
        const Vector2 line{out.x[at], out.y[at]};
        if (step.errors != nullptr && squaredLength(s.best - line) > kOnLine * kOnLine) {
            if (s.found.cost > kClearlyLess * out.cost[at]) continue;
            step.errors[row * step.errorPitch + 4 * std::ptrdiff_t{column}] =
                std::max(s.found.cost - kGoodCost, 0.0F) * kErrorPerCost;
        }
        put(out, column, row, s.best, s.found.cost, t.variance);
    }
}

void PropagateCells(const PropagateStep& step, int row, int first, int end) {
    Template t;
    for (int column = first; column < end; ++column) {
        const std::ptrdiff_t at = row * step.in.pitch + column;
        Search search;
        search.best = {step.in.x[at], step.in.y[at]};
        search.found.cost = step.in.cost[at];
        bool loaded = false, moved = false;
        const auto attempt = [&](int c, int r) HWY_ATTR {
            const Vector2 u = vectorOf(step.in, c, r);
            if (!search.tries(u)) return;
            if (!loaded) loadTemplate(step.from, column, row, t);
            loaded = true;
            moved = search.take(u, compare(t, step.to, column, row, u)) || moved;
        };
        attempt(column - 1, row);
        attempt(column + 1, row);
        attempt(column, row - 1);
        attempt(column, row + 1);
        if (moved) refine(t, step.to, column, row, step.steps, search);
        put(step.out, column, row, search.best, search.found.cost, step.in.texture[at]);
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(SearchCells);
HWY_EXPORT(SearchListedCells);
HWY_EXPORT(PropagateCells);

void searchCells(const SearchStep& step, int row, int first, int end) {
    HWY_DYNAMIC_DISPATCH(SearchCells)(step, row, first, end);
}

void searchListedCells(const ListedStep& step, int row, int first, int end) {
    HWY_DYNAMIC_DISPATCH(SearchListedCells)(step, row, first, end);
}

void propagateCells(const PropagateStep& step, int row, int first, int end) {
    HWY_DYNAMIC_DISPATCH(PropagateCells)(step, row, first, end);
}

}  // namespace mfar::simd
#endif
