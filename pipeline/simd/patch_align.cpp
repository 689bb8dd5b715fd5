#include "pipeline/simd/patch_flow.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/patch_align.cpp"
// clang-format off: these three includes must stay in this order
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "pipeline/simd/patch_batch_inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {

constexpr float kSteepest = params::kSteepestFlow;
// A patch's row is read in parts. All pixels of a part are read at the same whole-pixel offset. A
// part has eight pixels (the whole row) if the flow changes by less than kGentle per pixel along
// the row, else kHalf pixels. The error grows with the length of a part and with the change of the
// flow. With eight pixels at kGentle, it is no larger than with kHalf pixels at the steepest flow.
constexpr int kHalf = 4;
constexpr float kGentle = 1.0F / 10;
// If the flow changes by less than this per pixel, the change is ignored: all pixels of a patch are
// compared at the same flow vector. At the patch's corners, this vector is wrong by less than
// 0.03 px along each axis, which is less than the error of the estimated change.
constexpr float kFlat = 1.0F / 256;
// Number of bits of interpolation weights. Only 14 of the 16 stored bits are used, because a weight
// that changes along a row can leave the range [0, 1].
constexpr int kShareBits = 14;
constexpr float kShare = 1 << kShareBits;
// Values (pixel - 128) [1/32 grey level] are clamped to +-kMostValue, so that sums of their squares
// fit into 32 bits. Larger values occur only where the flow changes quickly from pixel to pixel and
// the contrast is high.
constexpr std::int16_t kMostValue = 5792;

struct Bend {
    Vector2 dx, dy;
};

/// Returns the change of the flow per pixel: the smaller of the two one-sided differences, or 0 if
/// their signs differ. `before` and `after` are two cells away, because between adjacent cells
/// noise exceeds the change.
HWY_INLINE float slopeOf(float before, float here, float after) {
    const float a = here - before, b = after - here;
    if (!(a * b > 0)) return 0;
    const float least = std::copysign(std::min(std::abs(a), std::abs(b)), b);
    return bounded(least / 8, -kSteepest, kSteepest);
}

/// Returns a component of a flow vector, or 0 if it is NaN or longer than any picture.
HWY_INLINE float soundOf(float v) {
    constexpr float kMost = 2e4F;
    return std::abs(v) < kMost ? v : 0;
}

HWY_INLINE Vector2 seedAt(const AlignStep& step, int column, int row) {
    const int c = std::clamp(column, 0, step.out.columns - 1);
    const int r = std::clamp(row, 0, step.out.rows - 1);
    const float* v = step.seed + 4 * (std::ptrdiff_t{r} * step.out.columns + c);
    return {soundOf(v[0]), soundOf(v[1])};
}

HWY_INLINE Bend bendAt(const AlignStep& step, int column, int row) {
    const auto slope = [](Vector2 before, Vector2 here, Vector2 after) {
        return Vector2{slopeOf(before.x, here.x, after.x), slopeOf(before.y, here.y, after.y)};
    };
    // Near the border of the field, a cell gets the slope of the nearest cell that has two cells on
    // either side.
    const int c = std::clamp(column, 2, std::max(step.out.columns - 3, 2));
    const int r = std::clamp(row, 2, std::max(step.out.rows - 3, 2));
    return {
        slope(seedAt(step, c - 2, row), seedAt(step, c, row), seedAt(step, c + 2, row)),
        slope(seedAt(step, column, r - 2), seedAt(step, column, r), seedAt(step, column, r + 2))};
}

/// Positions of the parts of a patch's rows in the searched picture. A part is a row if kParts is
/// 1, or half a row if kParts is 2. `upper`: offset of the pixel at a part's position. `lower`:
/// offset of the pixel below.
template <int kParts>
struct BentPlaces {
    static constexpr int kCount = kPatch * kParts;
    std::int32_t upper[kCount], lower[kCount];
    // Interpolation weights of the right column and of the lower row, each stored twice in 32 bits.
    std::int32_t shareX[kCount], shareY[kCount];
};

template <int kParts>
HWY_INLINE const float* firstColumns() {
    alignas(64) static constexpr float kColumns[2][2 * kPatch] = {
        {}, {0, 4, 0, 4, 0, 4, 0, 4, 0, 4, 0, 4, 0, 4, 0, 4}};
    return kColumns[kParts - 1];
}

template <int kParts>
HWY_INLINE const float* rowsOfParts() {
    alignas(64) static constexpr float kRows[2][2 * kPatch] = {
        {0, 1, 2, 3, 4, 5, 6, 7}, {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7}};
    return kRows[kParts - 1];
}

template <int kParts>
HWY_INLINE void placeParts(const PatchPicture& p, int column, int row, Vector2 u, const Bend& bend,
                           BentPlaces<kParts>& out) {
    const hn::CappedTag<float, BentPlaces<kParts>::kCount> d;
    const hn::RebindToSigned<decltype(d)> dInt;
    constexpr int kSpan = kPatch / kParts, kBeside = (kPatch - kSpan) / 2;
    const auto toX = hn::Set(d, static_cast<float>(patchStart(column, p.width)) + u.x);
    const auto toY = hn::Set(d, static_cast<float>(patchStart(row, p.height)) + u.y);
    // Shift of the patch from the position around the middle of its cell [px], see patchShift().
    const int shiftX = patchShift(column, p.width), shiftY = patchShift(row, p.height);
    const auto last = hn::Set(dInt, p.height - 1), zero = hn::Zero(dInt);
    const auto pitch = hn::Set(dInt, static_cast<std::int32_t>(p.pitch));
    const auto share = [&](auto value, auto whole, std::int32_t* to) HWY_ATTR {
        const auto s = hn::ConvertTo(dInt, hn::Mul(hn::Sub(value, whole), hn::Set(d, kShare)));
        hn::StoreU(hn::Or(s, hn::ShiftLeft<16>(s)), dInt, to);
    };
    // Clamps to [-7, most]; NaN becomes -7.
    const auto within = [&](auto value, int most) HWY_ATTR {
        const auto low = hn::Set(d, -7.0F), high = hn::Set(d, static_cast<float>(most));
        return hn::Min(hn::IfThenElse(hn::Gt(value, low), value, low), high);
    };
    for (std::size_t i = 0; i < BentPlaces<kParts>::kCount; i += hn::Lanes(d)) {
        const auto firstX = hn::Load(d, firstColumns<kParts>() + i);
        const auto firstY = hn::Load(d, rowsOfParts<kParts>() + i);
        const auto middleX = hn::Add(firstX, hn::Set(d, static_cast<float>(shiftX - kBeside)));
        const auto middleY = hn::Add(firstY, hn::Set(d, static_cast<float>(shiftY) - 3.5F));
        const auto moved = [&](auto from, float dx, float dy) HWY_ATTR {
            return hn::MulAdd(middleX, hn::Set(d, dx), hn::MulAdd(middleY, hn::Set(d, dy), from));
        };
        const auto x =
            within(moved(hn::Add(firstX, toX), bend.dx.x, bend.dy.x), p.width + 6 - kSpan);
        const auto y = within(moved(hn::Add(firstY, toY), bend.dx.y, bend.dy.y), p.height + 2);
        const auto left = hn::Floor(x), top = hn::Floor(y);
        const auto columns = hn::ConvertTo(dInt, left), rows = hn::ConvertTo(dInt, top);
        share(x, left, out.shareX + i);
        share(y, top, out.shareY + i);
        const auto offset = [&](auto lines) HWY_ATTR {
            return hn::Add(hn::Mul(hn::Min(hn::Max(lines, zero), last), pitch), columns);
        };
        hn::StoreU(offset(rows), dInt, out.upper + i);
        hn::StoreU(offset(hn::Add(rows, hn::Set(dInt, 1))), dInt, out.lower + i);
    }
}

/// Loads a row of a patch from its parts. `parts`: address of each part. `next`: number of pixels
/// to skip at the start of each part. On the scalar target, only the pixel in column c is loaded.
template <int kParts>
HWY_INLINE Vec16 loadParts(const std::uint8_t* const* parts, int next, int c) {
    if constexpr (kParts == 1) return loadPixels(parts[0] + next + c);
#if HWY_TARGET == HWY_SCALAR
    return hn::Set(Row16(), parts[c / kHalf][next + c % kHalf]);
#else
    const hn::FixedTag<std::uint8_t, kHalf> dHalf;
    const auto left = hn::LoadU(dHalf, parts[0] + next);
    const auto right = hn::LoadU(dHalf, parts[kParts - 1] + next);
    return hn::PromoteTo(Row16(), hn::Combine(Row8(), right, left));
#endif
}

template <int kParts>
HWY_INLINE Vec16 loadShares(const std::int32_t* shares, int c) {
    const Row16 d16;
    if constexpr (kParts == 1) return hn::Set(d16, static_cast<std::int16_t>(shares[0] & 0xFFFF));
#if HWY_TARGET == HWY_SCALAR
    return hn::Set(d16, static_cast<std::int16_t>(shares[c / kHalf] & 0xFFFF));
#else
    (void)c;
    const hn::FixedTag<std::int32_t, 2> dTwo;
    const hn::FixedTag<std::int32_t, 4> dFour;
    const auto two = hn::LoadU(dTwo, shares);
    const auto four = hn::Combine(dFour, two, two);
    return hn::BitCast(d16, hn::InterleaveLower(dFour, four, four));
#endif
}

/// Returns twice the column of each pixel of a row, relative to the centre of the pixel's part.
template <int kParts>
HWY_INLINE const std::int16_t* alongPart() {
    alignas(16) static constexpr std::int16_t kAlong[2][kPatch] = {{-7, -5, -3, -1, 1, 3, 5, 7},
                                                                   {-3, -1, 1, 3, -3, -1, 1, 3}};
    return kAlong[kParts - 1];
}

template <class D16>
struct BentPixels {
    hn::Vec<D16> shareX, shareY;

    HWY_INLINE hn::Vec<D16> across(hn::Vec<D16> here, hn::Vec<D16> next) const {
        const auto step = hn::ShiftLeft<kValueBits + 1>(hn::Sub(next, here));
        return hn::Add(hn::ShiftLeft<kValueBits>(here), hn::MulFixedPoint15(step, shareX));
    }
    /// Returns the values between two rows, minus 128.
    HWY_INLINE hn::Vec<D16> down(hn::Vec<D16> upper, hn::Vec<D16> lower) const {
        const D16 d;
        const auto most = hn::Set(d, kMostValue), middle = hn::Set(d, 128 << kValueBits);
        const auto step = hn::ShiftLeft<1>(hn::Sub(lower, upper));
        const auto v = hn::Sub(hn::Add(upper, hn::MulFixedPoint15(step, shareY)), middle);
        return hn::Min(hn::Max(v, hn::Neg(most)), most);
    }
};

/// Sums the products of a patch's pixels with the searched picture's pixels at `places`. `slopeX`,
/// `slopeY`: change of the interpolation weights along a row, per half pixel (the unit of
/// alongPart()).
template <int kParts>
HWY_INLINE void addUpParts(const Patch& patch, const std::uint8_t* pixels,
                           const BentPlaces<kParts>& places, std::int16_t slopeX,
                           std::int16_t slopeY, int cell, CompareSums& out) {
    const Row16 d16;
    RowProducts<Row16> products;
    ProductSum<Row16> b;
    for (int c = 0; c < kPatch; c += kRowLanes) {
        const auto along = hn::Load(d16, alongPart<kParts>() + c);
        const auto alongX = hn::Mul(along, hn::Set(d16, slopeX));
        const auto alongY = hn::Mul(along, hn::Set(d16, slopeY));
        for (int r = 0; r < kPatch; ++r) {
            const int first = kParts * r;
            const BentPixels<Row16> bent{
                hn::Add(loadShares<kParts>(places.shareX + first, c), alongX),
                hn::Add(loadShares<kParts>(places.shareY + first, c), alongY)};
            const auto between = [&](const std::int32_t* offsets) HWY_ATTR {
                const std::uint8_t* parts[kParts];
                for (int i = first; i < first + kParts; ++i)
                    parts[i - first] = pixels + offsets[i];
                return bent.across(loadParts<kParts>(parts, 0, c), loadParts<kParts>(parts, 1, c));
            };
            const auto v = bent.down(between(places.upper), between(places.lower));
            products.add(patch, kPatch * r + c, v);
            b.add(v, hn::Set(d16, 1));
        }
    }
    products.store(out, cell);
    b.store(out.b, cell);
}

#if HWY_MAX_BYTES >= 32
/// Like addUpParts(), but for rows with a single part (kParts = 1), and two rows at a time.
HWY_INLINE void addUpTwoRows(const Patch& patch, const std::uint8_t* pixels,
                             const BentPlaces<1>& places, std::int16_t slopeX, std::int16_t slopeY,
                             int cell, CompareSums& out) {
    const Rows16 d;
    const Row16 dRow;
    RowProducts<Rows16> products;
    ProductSum<Rows16> b;
    const auto inBoth = [&](auto row) HWY_ATTR { return hn::Combine(d, row, row); };
    const auto along = inBoth(hn::Load(dRow, alongPart<1>()));
    const auto alongX = hn::Mul(along, hn::Set(d, slopeX));
    const auto alongY = hn::Mul(along, hn::Set(d, slopeY));
    for (int r = 0; r < kPatch; r += 2) {
        const auto share = [&](const std::int32_t* of) HWY_ATTR {
            return hn::Combine(d, loadShares<1>(of + r + 1, 0), loadShares<1>(of + r, 0));
        };
        const BentPixels<Rows16> bent{hn::Add(share(places.shareX), alongX),
                                      hn::Add(share(places.shareY), alongY)};
        const auto between = [&](const std::int32_t* offsets) HWY_ATTR {
            const std::uint8_t *first = pixels + offsets[r], *second = pixels + offsets[r + 1];
            return bent.across(loadTwoRows(first, second), loadTwoRows(first + 1, second + 1));
        };
        const auto v = bent.down(between(places.upper), between(places.lower));
        products.add(patch, kPatch * r, v);
        b.add(v, hn::Set(d, 1));
    }
    products.store(out, cell);
    b.store(out.b, cell);
}
#endif

/// Compares like comparePatch() (patch_inl.h), but with a flow that changes over the patch.
template <int kParts>
HWY_INLINE void compareBent(const Patch& patch, const PatchPicture& p, int column, int row,
                            Vector2 u, const Bend& bend, int cell, CompareSums& out) {
    BentPlaces<kParts> places;
    placeParts<kParts>(p, column, row, u, bend, places);
    const auto slopeX = static_cast<std::int16_t>(bend.dx.x * (kShare / 2));
    const auto slopeY = static_cast<std::int16_t>(bend.dx.y * (kShare / 2));
#if HWY_MAX_BYTES >= 32
    if constexpr (kParts == 1)
        addUpTwoRows(patch, p.pixels, places, slopeX, slopeY, cell, out);
    else
#endif
        addUpParts<kParts>(patch, p.pixels, places, slopeX, slopeY, cell, out);
}

struct AlignRoom {
    Batch batch;
    PatchSums patchSums;
    CompareSums sums;
    Bend bend[kBatch];
};

/// Finds the cheapest flow vector of each cell: its seed, or a result of Gauss-Newton steps that
/// start at the seed.
HWY_INLINE void alignBatch(const AlignStep& step, AlignRoom& room) {
    Batch& batch = room.batch;
    loadPatches(step.from, room.patchSums, batch);
    for (int i = 0; i < batch.count; ++i) {
        const Vector2 u = seedAt(step, batch.column[i], batch.row[i]);
        room.bend[i] = bendAt(step, batch.column[i], batch.row[i]);
        batch.trial.x.of[i] = batch.best.x.of[i] = u.x;
        batch.trial.y.of[i] = batch.best.y.of[i] = u.y;
        batch.cost.of[i] = 1e9F;
        batch.active.of[i] = 1;
    }
    const auto compare = [&](int i) HWY_ATTR {
        const Bend& bend = room.bend[i];
        const Vector2 u{batch.trial.x.of[i], batch.trial.y.of[i]};
        const Patch& patch = batch.patch[i];
        const float alongRow = std::max(std::abs(bend.dx.x), std::abs(bend.dx.y));
        const float downRows = std::max(std::abs(bend.dy.x), std::abs(bend.dy.y));
        if (std::max(alongRow, downRows) < kFlat)
            comparePatch(patch, step.to, batch.column[i], batch.row[i], u, i, room.sums);
        else if (alongRow < kGentle)
            compareBent<1>(patch, step.to, batch.column[i], batch.row[i], u, bend, i, room.sums);
        else
            compareBent<2>(patch, step.to, batch.column[i], batch.row[i], u, bend, i, room.sums);
    };
    for (int k = 0;; ++k) {
        tryActive(compare, room.sums, batch);
        if (k == step.steps) break;
        stepActive(batch);
    }
    for (int i = 0; i < batch.count; ++i)
        putBest(step.out, batch, i);
}

}  // namespace

void AlignCells(const AlignStep& step, int row, int first, int end) {
    AlignRoom room;
    for (int column = first; column < end; column += kBatch) {
        room.batch.count = 0;
        for (int c = column; c < std::min(column + kBatch, end); ++c)
            room.batch.add(c, row);
        alignBatch(step, room);
    }
}

void KeepSeedCells(const AlignStep& step, int row, int first, int end) {
    for (int column = first; column < end; ++column) {
        const Vector2 u = seedAt(step, column, row);
        const std::ptrdiff_t at = row * step.out.pitch + column;
        step.out.x[at] = u.x;
        step.out.y[at] = u.y;
        step.out.cost[at] = step.out.texture[at] = 0;
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(AlignCells);
HWY_EXPORT(KeepSeedCells);

void alignCells(const AlignStep& step, int row, int first, int end) {
    HWY_DYNAMIC_DISPATCH(AlignCells)(step, row, first, end);
}

void keepSeedCells(const AlignStep& step, int row, int first, int end) {
    HWY_DYNAMIC_DISPATCH(KeepSeedCells)(step, row, first, end);
}

}  // namespace mfar::simd
#endif
