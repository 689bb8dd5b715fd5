#include "pipeline/simd/patch_flow.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/patch_search.cpp"
// clang-format off: these three includes must stay in this order
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "pipeline/simd/patch_batch_inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {

constexpr int kMostRadius = 40;
constexpr std::size_t kMostSide = 2 * kMostRadius + 1, kSideRoom = kMostSide + 15;

struct SearchRoom {
    Batch batch;
    PatchSums patchSums;
    CompareSums sums;

    HWY_INLINE void load(const PatchPicture& from) {
        loadPatches(from, patchSums, batch);
        for (int i = 0; i < batch.count; ++i) {
            batch.best.x.of[i] = batch.best.y.of[i] = batch.cost.of[i] = 1e9F;
            batch.descent.x.of[i] = batch.descent.y.of[i] = 0;
        }
    }
    HWY_INLINE void compare(const PatchPicture& to) {
        tryActive(
            [&](int i) HWY_ATTR {
                comparePatch(batch.patch[i], to, batch.column[i], batch.row[i],
                             {batch.trial.x.of[i], batch.trial.y.of[i]}, i, sums);
            },
            sums, batch);
    }
};

HWY_INLINE void activateNew(Batch& batch) {
    const Cells d;
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
        const Lanes2 trial = at(batch.trial, i), best = at(batch.best, i);
        const Vec squared = squaredLength({hn::Sub(trial.x, best.x), hn::Sub(trial.y, best.y)});
        const auto isNew = hn::Ge(squared, hn::Set(d, params::kSameCandidate));
        batch.active.set(i, hn::IfThenElseZero(isNew, hn::Set(d, 1.0F)));
    }
}

HWY_INLINE void refine(const PatchPicture& to, int steps, SearchRoom& room) {
    for (int k = 0; k < steps; ++k) {
        stepActive(room.batch);
        room.compare(to);
    }
}

HWY_INLINE Vector2 vectorOf(const FlowPlanes& field, int column, int row) {
    const std::ptrdiff_t at =
        std::clamp(row, 0, field.rows - 1) * field.pitch + std::clamp(column, 0, field.columns - 1);
    return {field.x[at], field.y[at]};
}

struct WholeSums {
    alignas(64) float b[kSideRoom], bb[kSideRoom], ab[kSideRoom], cost[kSideRoom];
};

HWY_INLINE void sumWhole(const Patch& patch, const PatchRows& rows, std::size_t at,
                         WholeSums& out) {
    const Row16 d16;
    const Sum32 d32;
    const auto middle = hn::Set(d16, 128);
    ProductSum<Row16> bb, ab, b;
    for (int c = 0; c < kPatch; c += kRowLanes) {
        auto columns = hn::Zero(d16);
        for (int r = 0; r < kPatch; ++r) {
            const auto v = hn::Sub(loadPixels(rows[r] + c), middle);
            columns = hn::Add(columns, v);
            bb.add(v, v);
            ab.add(v, hn::Load(d16, patch.pixels + kPatch * r + c));
        }
        b.add(columns, hn::Set(d16, 1));
    }
    const auto sum = [&](const ProductSum<Row16>& s) HWY_ATTR {
        return static_cast<float>(hn::GetLane(hn::SumOfLanes(d32, s.parts())));
    };
    out.b[at] = sum(b);
    out.bb[at] = sum(bb);
    out.ab[at] = sum(ab);
}

/// Computes the costs of `count` displacements, as takeBetter() does.
HWY_INLINE void costsOf(float patchMean, float patchVariance, std::size_t count, WholeSums& sums) {
    const Cells d;
    const auto mean = hn::Set(d, patchMean), variance = hn::Set(d, patchVariance);
    const auto noise = hn::Set(d, params::kPatchNoise);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const Vec b = hn::Load(d, sums.b + i);
        const Vec meanB = hn::Mul(b, hn::Set(d, 1 / kPixels));
        const Vec varianceB =
            hn::Max(hn::NegMulAdd(b, meanB, hn::Load(d, sums.bb + i)), hn::Zero(d));
        const Vec covariance = hn::NegMulAdd(mean, b, hn::Load(d, sums.ab + i));
        const Vec squaredGain = hn::Div(hn::Add(variance, noise), hn::Add(varianceB, noise));
        const Vec gain = hn::Sqrt(squaredGain);
        const Vec energy = hn::MulAdd(squaredGain, varianceB, variance);
        const Vec off = hn::NegMulAdd(hn::Add(gain, gain), covariance, energy);
        hn::Store(hn::Div(hn::Max(off, hn::Zero(d)), hn::Add(energy, noise)), d, sums.cost + i);
    }
}

struct WholeBest {
    float x, y, cost;
};

/// Compares the patch with `to` at the displacements (dx, dy), dx from `firstDx` to `endDx` - 1.
/// `best` becomes the displacement with the least cost. If costs are equal, the first displacement
/// wins.
HWY_INLINE void searchWholeRow(const Batch& batch, int cell, const PatchPicture& to, int firstDx,
                               int endDx, int dy, WholeSums& sums, WholeBest& best) {
    const int y = std::clamp(patchStart(batch.row[cell], to.height) + dy, -7, to.height - 2);
    for (int dx = firstDx; dx < endDx; ++dx) {
        const int x = std::clamp(patchStart(batch.column[cell], to.width) + dx, -7, to.width - 2);
        sumWhole(batch.patch[cell], PatchRows(to, x, y, kPatch, kPatch),
                 static_cast<std::size_t>(dx - firstDx), sums);
    }
    costsOf(batch.mean.of[cell], batch.variance.of[cell], static_cast<std::size_t>(endDx - firstDx),
            sums);
    for (int dx = firstDx; dx < endDx; ++dx) {
        const float cost = sums.cost[dx - firstDx];
        if (!(cost < best.cost)) continue;
        const float x = static_cast<float>(dx) - best.x, v = static_cast<float>(dy) - best.y;
        if (x * x + v * v >= params::kSameCandidate)
            best = {static_cast<float>(dx), static_cast<float>(dy), cost};
    }
}

/// Compares the patch at all whole-pixel displacements of at most `radius` along each axis. Stores
/// the cheapest one in batch.trial. If none costs less than batch.best, stores batch.best there.
/// Displacement zero is compared first, so it wins over the others if the patch has no texture.
void searchWhole(Batch& batch, int cell, const PatchPicture& to, int radius) {
    WholeSums sums{};
    WholeBest best{batch.best.x.of[cell], batch.best.y.of[cell], batch.cost.of[cell]};
    searchWholeRow(batch, cell, to, 0, radius + 1, 0, sums, best);
    for (int dy = 1; dy <= radius; ++dy)
        searchWholeRow(batch, cell, to, -radius, radius + 1, dy, sums, best);
    for (int dy = -radius; dy < 0; ++dy)
        searchWholeRow(batch, cell, to, -radius, radius + 1, dy, sums, best);
    searchWholeRow(batch, cell, to, -radius, 0, 0, sums, best);
    batch.trial.x.of[cell] = best.x;
    batch.trial.y.of[cell] = best.y;
}

HWY_INLINE void tryPrior(const SearchStep& step, SearchRoom& room) {
    Batch& batch = room.batch;
    const PriorField& p = step.prior;
    for (int i = 0; i < batch.count; ++i) {
        const auto c =
            static_cast<int>((static_cast<float>(batch.column[i]) + 0.5F) * p.columnsPerCell);
        const auto r = static_cast<int>((static_cast<float>(batch.row[i]) + 0.5F) * p.rowsPerCell);
        const std::ptrdiff_t at = r * p.pitch + c * p.step;
        batch.trial.x.of[i] = p.scale * p.x[at];
        batch.trial.y.of[i] = p.scale * p.y[at];
    }
    activateNew(batch);
    room.compare(step.to);
}

/// Compares each cell's patch at the k-th of the four flow vectors that surround the cell at the
/// next coarser pyramid level. The vector k = 0 is the nearest.
HWY_INLINE void tryCoarser(const SearchStep& step, int k, SearchRoom& room) {
    Batch& batch = room.batch;
    for (int i = 0; i < batch.count; ++i) {
        const int towardsX = (batch.column[i] & 1) * 2 - 1, towardsY = (batch.row[i] & 1) * 2 - 1;
        const Vector2 u = vectorOf(step.coarser, (batch.column[i] >> 1) + (k & 1) * towardsX,
                                   (batch.row[i] >> 1) + (k >> 1) * towardsY);
        batch.trial.x.of[i] = 2 * u.x;
        batch.trial.y.of[i] = 2 * u.y;
    }
    activateNew(batch);
    room.compare(step.to);
}

void searchBatch(const SearchStep& step, SearchRoom& room) {
    room.load(step.from);
    if (step.prior.x != nullptr) tryPrior(step, room);
    if (step.coarser.rows == 0) {
        for (int i = 0; i < room.batch.count; ++i)
            searchWhole(room.batch, i, step.to, std::min(step.radius, kMostRadius));
        activateNew(room.batch);
        room.compare(step.to);
    } else {
        for (int k = 0; k < step.candidates; ++k)
            tryCoarser(step, k, room);
    }
    for (int i = 0; i < room.batch.count; ++i)
        room.batch.active.of[i] = 1;
    refine(step.to, step.steps, room);
}

}  // namespace

void SearchCells(const SearchStep& step, int row, int first, int end) {
    SearchRoom room;
    for (int column = first; column < end; column += kBatch) {
        room.batch.count = 0;
        for (int c = column; c < std::min(column + kBatch, end); ++c)
            room.batch.add(c, row);
        searchBatch(step, room);
        for (int i = 0; i < room.batch.count; ++i)
            putBest(step.out, room.batch, i);
    }
}

void SearchListedGroup(const ListedStep& step, int groupX, int groupY) {
    using params::kClearlyLess, params::kErrorPerCost, params::kGoodCost, params::kOnLine;
    constexpr int kSide = 4;
    static_assert(kSide * kSide == kBatch);
    const FlowPlanes& out = step.search.out;
    SearchRoom room;
    Batch& batch = room.batch;
    for (int i = 0; i < kBatch; ++i) {
        const int c = kSide * groupX + i % kSide, r = kSide * groupY + i / kSide;
        if (c < out.columns && r < out.rows) batch.add(c, r);
    }
    searchBatch(step.search, room);
    for (int i = 0; i < batch.count; ++i) {
        const std::ptrdiff_t at = batch.row[i] * out.pitch + batch.column[i];
        const float x = batch.best.x.of[i] - out.x[at], y = batch.best.y.of[i] - out.y[at];
        if (step.errors != nullptr && x * x + y * y > kOnLine * kOnLine) {
            const float cost = batch.cost.of[i];
            if (cost > kClearlyLess * out.cost[at]) continue;
            step.errors[batch.row[i] * step.errorPitch + 4 * std::ptrdiff_t{batch.column[i]}] =
                std::max(cost - kGoodCost, 0.0F) * kErrorPerCost;
        }
        putBest(out, batch, i);
    }
}

namespace {

struct Offset {
    int x, y;
};
constexpr Offset kBeside[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

HWY_INLINE bool differsFromNeighbours(const FlowPlanes& field, int column, int row) {
    const Vector2 own = vectorOf(field, column, row);
    bool differs = false;
    for (const Offset by : kBeside) {
        const Vector2 u = vectorOf(field, column + by.x, row + by.y);
        const float x = u.x - own.x, y = u.y - own.y;
        differs = differs || x * x + y * y >= params::kSameCandidate;
    }
    return differs;
}

void propagateBatch(const PropagateStep& step, SearchRoom& room) {
    Batch& batch = room.batch;
    room.load(step.from);
    Each moved;
    for (int i = 0; i < batch.count; ++i) {
        const std::ptrdiff_t at = batch.row[i] * step.in.pitch + batch.column[i];
        batch.best.x.of[i] = step.in.x[at];
        batch.best.y.of[i] = step.in.y[at];
        batch.cost.of[i] = step.in.cost[at];
        moved.of[i] = 0;
    }
    for (const Offset by : kBeside) {
        for (int i = 0; i < batch.count; ++i) {
            const Vector2 u = vectorOf(step.in, batch.column[i] + by.x, batch.row[i] + by.y);
            batch.trial.x.of[i] = u.x;
            batch.trial.y.of[i] = u.y;
        }
        activateNew(batch);
        room.compare(step.to);
        for (int i = 0; i < batch.count; ++i)
            moved.of[i] = std::max(moved.of[i], batch.active.of[i]);
    }
    batch.active = moved;
    refine(step.to, step.steps, room);
    for (int i = 0; i < batch.count; ++i)
        putBest(step.out, batch, i);
    batch.count = 0;
}

}  // namespace

void PropagateCells(const PropagateStep& step, int row, int first, int end) {
    SearchRoom room;
    for (int column = first; column < end; ++column) {
        if (differsFromNeighbours(step.in, column, row)) {
            room.batch.add(column, row);
            if (room.batch.count == kBatch) propagateBatch(step, room);
            continue;
        }
        const std::ptrdiff_t from = row * step.in.pitch + column;
        const std::ptrdiff_t to = row * step.out.pitch + column;
        step.out.x[to] = step.in.x[from];
        step.out.y[to] = step.in.y[from];
        step.out.cost[to] = step.in.cost[from];
        step.out.texture[to] = step.in.texture[from];
    }
    if (room.batch.count > 0) propagateBatch(step, room);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(SearchCells);
HWY_EXPORT(SearchListedGroup);
HWY_EXPORT(PropagateCells);

void searchCells(const SearchStep& step, int row, int first, int end) {
    HWY_DYNAMIC_DISPATCH(SearchCells)(step, row, first, end);
}

void searchListedGroup(const ListedStep& step, int groupX, int groupY) {
    HWY_DYNAMIC_DISPATCH(SearchListedGroup)(step, groupX, groupY);
}

void propagateCells(const PropagateStep& step, int row, int first, int end) {
    HWY_DYNAMIC_DISPATCH(PropagateCells)(step, row, first, end);
}

}  // namespace mfar::simd
#endif
