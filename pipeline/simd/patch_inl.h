// Sums over an 8x8 patch of one luma level and the pixels of another: patch.glsl in integers.
// Included once for each instruction set. Pixels are kept less 128, so that sums of squares fit
// into 32 bits: the offsets cancel in every result.
#if defined(MFAR_PATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_PATCH_INL_H
#undef MFAR_PATCH_INL_H
#else
#define MFAR_PATCH_INL_H
#endif

#include "pipeline/engine/params/patch.h"
#include "pipeline/simd/patch_flow.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kPatch = 8;     // pixels a side
constexpr int kCellSize = 4;  // pixels a side; its patch begins two pixels left and above
constexpr float kPixels = params::kPatchPixels;
// A pixel of the other picture is kept in 1/32 of a grey level.
constexpr int kValueBits = 5;
constexpr float kValue = 1 << kValueBits;

// A row of a patch, or one pixel on the scalar target.
using Row16 = hn::CappedTag<std::int16_t, kPatch>;
using Sum32 = hn::CappedTag<std::int32_t, kPatch / 2>;
using Row8 = hn::Rebind<std::uint8_t, Row16>;
using Vec16 = hn::Vec<Row16>;
using Vec32 = hn::Vec<Sum32>;
constexpr int kRowLanes = HWY_TARGET == HWY_SCALAR ? 1 : kPatch;

// Cells that are searched together: the work after a comparison runs for all at once, one cell per
// lane.
constexpr int kBatch = 16;
using Cells = hn::CappedTag<float, kBatch>;
using CellsInt = hn::RebindToSigned<Cells>;
using Vec = hn::Vec<Cells>;

struct Vector2 {
    float x, y;
};
/// NaN becomes the lower bound.
HWY_INLINE float bounded(float v, float low, float high) {
    const float least = v > low ? v : low;
    return least < high ? least : high;
}

/// The patch of a cell: its pixels, and twice their central differences.
struct alignas(64) Patch {
    std::int16_t pixels[64], gx[64], gy[64];
};

/// Partial sums over a patch's pixels: four per cell.
struct alignas(64) Parts {
    std::int32_t of[kBatch][4] = {};

    /// Sums for a vector of cells, in units of `unit`.
    [[nodiscard]] HWY_INLINE Vec sum(std::size_t i, float unit) const {
        const CellsInt d;
        hn::Vec<CellsInt> a, b, c, e;
        hn::LoadInterleaved4(d, of[i], a, b, c, e);
        const auto total = hn::Add(hn::Add(a, b), hn::Add(c, e));
        return hn::Mul(hn::ConvertTo(Cells(), total), hn::Set(Cells(), unit));
    }
};

/// Sum of products of 16-bit lanes, for one row or two.
template <class D16>
struct ProductSum {
    using D32 = hn::CappedTag<std::int32_t, HWY_MAX(hn::MaxLanes(D16()) / 2, 1)>;
    hn::Vec<D32> even, odd;

    // Explicit, because a compiler-generated constructor is not compiled for the instruction set.
    HWY_INLINE ProductSum() : even(hn::Zero(D32())), odd(hn::Zero(D32())) {}
    HWY_INLINE void add(hn::Vec<D16> a, hn::Vec<D16> b) {
        even = hn::ReorderWidenMulAccumulate(D32(), a, b, even, odd);
    }
    [[nodiscard]] HWY_INLINE Vec32 parts() const {
        const auto all = hn::Add(even, odd);
#if HWY_MAX_BYTES >= 32
        if constexpr (hn::MaxLanes(D16()) > kPatch)
            return hn::Add(hn::LowerHalf(Sum32(), all), hn::UpperHalf(Sum32(), all));
        else
#endif
            return all;
    }
    HWY_INLINE void store(Parts& to, int cell) const { hn::StoreU(parts(), Sum32(), to.of[cell]); }
};

HWY_INLINE Vec16 loadPixels(const std::uint8_t* from) {
    return hn::PromoteTo(Row16(), hn::LoadU(Row8(), from));
}

/// Rows of pixels that may be read without bounds checks; rows outside the picture repeat its
/// border.
class PatchRows {
public:
    /// `rows` rows from `y`, `bytes` bytes from `x`, up to kWidth.
    HWY_INLINE PatchRows(const PatchPicture& p, int x, int y, int rows, int bytes) {
        if (y >= 0 && y + rows <= p.height) {
            first_ = p.pixels + y * p.pitch + x;
            pitch_ = p.pitch;
            return;
        }
        for (int r = 0; r < rows; ++r)
            std::memcpy(copy_ + r * kWidth,
                        p.pixels + std::clamp(y + r, 0, p.height - 1) * p.pitch + x,
                        static_cast<std::size_t>(bytes));
        first_ = copy_;
        pitch_ = kWidth;
    }
    PatchRows(const PatchRows&) = delete;
    PatchRows& operator=(const PatchRows&) = delete;

    [[nodiscard]] HWY_INLINE const std::uint8_t* operator[](int r) const {
        return first_ + r * pitch_;
    }

private:
    static constexpr int kWidth = 16;
    const std::uint8_t* first_;
    std::ptrdiff_t pitch_;
    std::uint8_t copy_[10 * kWidth];
};

/// The sums of loadPatch().
struct PatchSums {
    Parts a, x, y, aa, ax, ay, xx, xy, yy;
};

/// Products of pixels and gradients, summed over a patch.
struct PatchProducts {
    ProductSum<Row16> aa, ax, ay, xx, xy, yy;

    HWY_INLINE PatchProducts() : aa(), ax(), ay(), xx(), xy(), yy() {}
    HWY_INLINE void add(hn::Vec<Row16> a, hn::Vec<Row16> gx, hn::Vec<Row16> gy) {
        aa.add(a, a);
        ax.add(a, gx);
        ay.add(a, gy);
        xx.add(gx, gx);
        xy.add(gx, gy);
        yy.add(gy, gy);
    }
    HWY_INLINE void store(PatchSums& sums, int cell) {
        aa.store(sums.aa, cell);
        ax.store(sums.ax, cell);
        ay.store(sums.ay, cell);
        xx.store(sums.xx, cell);
        xy.store(sums.xy, cell);
        yy.store(sums.yy, cell);
    }
};

HWY_INLINE void loadPatch(const PatchPicture& p, int column, int row, int cell, Patch& out,
                          PatchSums& sums) {
    const Row16 d16;
    const PatchRows rows(p, kCellSize * column - 3, kCellSize * row - 3, kPatch + 2, kPatch + 2);
    const auto middle = hn::Set(d16, 128), one = hn::Set(d16, 1);
    PatchProducts products;
    ProductSum<Row16> sumA, sumX, sumY;
    for (int c = 0; c < kPatch; c += kRowLanes) {
        auto above = loadPixels(rows[0] + c + 1), here = loadPixels(rows[1] + c + 1);
        // At most eight times 255.
        auto columnsA = hn::Zero(d16), columnsX = hn::Zero(d16), columnsY = hn::Zero(d16);
        for (int r = 0; r < kPatch; ++r) {
            const std::uint8_t* line = rows[r + 1] + c;
            const auto below = loadPixels(rows[r + 2] + c + 1);
            const auto gx = hn::Sub(loadPixels(line + 2), loadPixels(line));
            const auto gy = hn::Sub(below, above);
            const auto a = hn::Sub(here, middle);
            hn::Store(a, d16, out.pixels + kPatch * r + c);
            hn::Store(gx, d16, out.gx + kPatch * r + c);
            hn::Store(gy, d16, out.gy + kPatch * r + c);
            columnsA = hn::Add(columnsA, a);
            columnsX = hn::Add(columnsX, gx);
            columnsY = hn::Add(columnsY, gy);
            products.add(a, gx, gy);
            above = here;
            here = below;
        }
        sumA.add(columnsA, one);
        sumX.add(columnsX, one);
        sumY.add(columnsY, one);
    }
    sumA.store(sums.a, cell);
    sumX.store(sums.x, cell);
    sumY.store(sums.y, cell);
    products.store(sums, cell);
}

/// Sums of the other picture's pixels, their squares, and their products with the patch's pixels
/// and gradients.
struct CompareSums {
    Parts b, bb, ab, xb, yb;
};

/// All of these but the first, row by row.
template <class D16>
struct RowProducts {
    ProductSum<D16> bb, ab, xb, yb;

    HWY_INLINE RowProducts() : bb(), ab(), xb(), yb() {}
    HWY_INLINE void add(const Patch& patch, int at, hn::Vec<D16> value) {
        const D16 d16;
        bb.add(value, value);
        ab.add(hn::Load(d16, patch.pixels + at), value);
        xb.add(hn::Load(d16, patch.gx + at), value);
        yb.add(hn::Load(d16, patch.gy + at), value);
    }
    HWY_INLINE void store(CompareSums& sums, int cell) const {
        bb.store(sums.bb, cell);
        ab.store(sums.ab, cell);
        xb.store(sums.xb, cell);
        yb.store(sums.yb, cell);
    }
};

/// Interpolates a row's pixels and their right neighbours; result less 128.
template <class D16>
HWY_INLINE hn::Vec<D16> betweenColumns(hn::Vec<D16> here, hn::Vec<D16> next, hn::Vec<D16> right) {
    const auto step = hn::ShiftLeft<kValueBits>(hn::Sub(next, here));
    const auto middle = hn::Set(D16(), 128 << kValueBits);
    return hn::Add(hn::Sub(hn::ShiftLeft<kValueBits>(here), middle),
                   hn::MulFixedPoint15(step, right));
}

#if HWY_MAX_BYTES >= 32
// Two rows of a patch in one vector.
using Rows16 = hn::CappedTag<std::int16_t, 2 * kPatch>;

HWY_INLINE hn::Vec<Rows16> loadTwoRows(const std::uint8_t* upper, const std::uint8_t* lower) {
    const hn::FixedTag<std::uint8_t, 2 * kPatch> d8;
    return hn::PromoteTo(Rows16(),
                         hn::Combine(d8, hn::LoadU(Row8(), lower), hn::LoadU(Row8(), upper)));
}

/// Sums the products of a patch with pixels interpolated between rows of the other picture.
HWY_INLINE void addUpRows(const Patch& patch, const PatchRows& rows, std::int16_t across,
                          std::int16_t along, int cell, CompareSums& out) {
    const Rows16 d;
    const auto right = hn::Set(d, across), down = hn::Set(d, along);
    const auto between = [&](int upper, int lower) HWY_ATTR {
        return betweenColumns<Rows16>(loadTwoRows(rows[upper], rows[lower]),
                                      loadTwoRows(rows[upper] + 1, rows[lower] + 1), right);
    };
    RowProducts<Rows16> products;
    auto above = between(0, 1), columns = hn::Zero(d);
    for (int r = 0; r < kPatch; r += 2) {
        const auto next = between(r + 2, std::min(r + 3, kPatch));
        const auto below = hn::ConcatLowerUpper(d, next, above);
        const auto v = hn::Add(above, hn::MulFixedPoint15(hn::Sub(below, above), down));
        columns = hn::Add(columns, v);
        products.add(patch, kPatch * r, v);
        above = next;
    }
    ProductSum<Rows16> b;
    b.add(columns, hn::Set(d, 1));
    products.store(out, cell);
    b.store(out.b, cell);
}
#else
HWY_INLINE void addUpRows(const Patch& patch, const PatchRows& rows, std::int16_t across,
                          std::int16_t along, int cell, CompareSums& out) {
    const Row16 d;
    const auto right = hn::Set(d, across), down = hn::Set(d, along);
    const auto between = [&](const std::uint8_t* from) HWY_ATTR {
        return betweenColumns<Row16>(loadPixels(from), loadPixels(from + 1), right);
    };
    RowProducts<Row16> products;
    ProductSum<Row16> b;
    for (int c = 0; c < kPatch; c += kRowLanes) {
        auto above = between(rows[0] + c), columns = hn::Zero(d);
        for (int r = 0; r < kPatch; ++r) {
            const auto below = between(rows[r + 1] + c);
            const auto v = hn::Add(above, hn::MulFixedPoint15(hn::Sub(below, above), down));
            columns = hn::Add(columns, v);  // at most eight times 4096
            products.add(patch, kPatch * r + c, v);
            above = below;
        }
        b.add(columns, hn::Set(d, 1));
    }
    products.store(out, cell);
    b.store(out.b, cell);
}
#endif

/// Compares the patch with a level, displaced by u pixels. Positions outside are clamped to the
/// border.
HWY_INLINE void comparePatch(const Patch& patch, const PatchPicture& p, int column, int row,
                             Vector2 u, int cell, CompareSums& out) {
    const float x = bounded(static_cast<float>(kCellSize * column - 2) + u.x, -7.0F,
                            static_cast<float>(p.width - 2));
    const float y = bounded(static_cast<float>(kCellSize * row - 2) + u.y, -7.0F,
                            static_cast<float>(p.height - 2));
    const float left = std::floor(x), top = std::floor(y);
    const auto shareOf = [](float v) { return static_cast<std::int16_t>(v * 32767); };
    addUpRows(patch,
              PatchRows(p, static_cast<int>(left), static_cast<int>(top), kPatch + 1, kPatch + 1),
              shareOf(x - left), shareOf(y - top), cell, out);
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
