// Comparison of 8x8 patches between two luma levels, invariant to offset and gain: patch.glsl in
// integers. Included once for each instruction set.
// Pixels are kept less 128, so that sums of squares fit 32 bits: offsets cancel in every result.
#if defined(MFAR_PATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_PATCH_INL_H
#undef MFAR_PATCH_INL_H
#else
#define MFAR_PATCH_INL_H
#endif

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
constexpr float kPixels = 64;
// Energy of noise in a patch [grey levels^2]: below it a patch counts as flat.
constexpr float kNoise = 128;
// Added to the diagonal of the Hessian: keeps steps finite where there is no gradient.
constexpr float kDamping = 64;
// Squared length [px^2] below which a step ends the search, and two candidates are one.
constexpr float kShortestStep = 2.5e-5F, kSameCandidate = 0.25F;
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

struct Vector2 {
    float x, y;
};
HWY_INLINE Vector2 operator+(Vector2 a, Vector2 b) {
    return {a.x + b.x, a.y + b.y};
}
HWY_INLINE Vector2 operator-(Vector2 a, Vector2 b) {
    return {a.x - b.x, a.y - b.y};
}
HWY_INLINE Vector2 operator*(float s, Vector2 a) {
    return {s * a.x, s * a.y};
}
HWY_INLINE float squaredLength(Vector2 a) {
    return a.x * a.x + a.y * a.y;
}
/// NaN becomes the lower bound.
HWY_INLINE float bounded(float v, float low, float high) {
    const float least = v > low ? v : low;
    return least < high ? least : high;
}

/// The patch of a cell: its pixels, twice its central differences, and what they add up to.
struct Template {
    alignas(16) std::int16_t pixels[64];
    alignas(16) std::int16_t gx[64];
    alignas(16) std::int16_t gy[64];
    float mean, variance;
    Vector2 sumG, sumAG;
    float inverseXx, inverseXy, inverseYy;
};

struct Match {
    float cost = 1e9F;
    Vector2 descent{0, 0};  // right-hand side of the Gauss-Newton step
};

/// Sum of products of 16-bit lanes.
struct ProductSum {
    Vec32 even, odd;

    // Those that a compiler makes are for no instruction set.
    HWY_INLINE ProductSum() : even(hn::Zero(Sum32())), odd(hn::Zero(Sum32())) {}
    HWY_INLINE void add(Vec16 a, Vec16 b) {
        even = hn::ReorderWidenMulAccumulate(Sum32(), a, b, even, odd);
    }
    [[nodiscard]] HWY_INLINE Vec32 total() const { return hn::Add(even, odd); }
};

/// The sums of four vectors' lanes.
HWY_INLINE void sumLanes(Vec32 a, Vec32 b, Vec32 c, Vec32 d, float* out) {
    const hn::RebindToFloat<Sum32> dFloat;
#if HWY_TARGET == HWY_SCALAR
    int i = 0;
    for (const Vec32 v : {a, b, c, d})
        hn::StoreU(hn::ConvertTo(dFloat, v), dFloat, out + i++);
#else
    const Sum32 d32;
    const hn::Repartition<std::int64_t, Sum32> d64;
    const auto ab =
        hn::BitCast(d64, hn::Add(hn::InterleaveLower(d32, a, b), hn::InterleaveUpper(d32, a, b)));
    const auto cd =
        hn::BitCast(d64, hn::Add(hn::InterleaveLower(d32, c, d), hn::InterleaveUpper(d32, c, d)));
    const auto sums = hn::Add(hn::BitCast(d32, hn::InterleaveLower(d64, ab, cd)),
                              hn::BitCast(d32, hn::InterleaveUpper(d64, ab, cd)));
    hn::StoreU(hn::ConvertTo(dFloat, sums), dFloat, out);
#endif
}

HWY_INLINE Vec16 loadPixels(const std::uint8_t* from) {
    return hn::PromoteTo(Row16(), hn::LoadU(Row8(), from));
}

/// Rows of pixels that may be read as they are; rows outside the picture repeat its border.
class PatchRows {
public:
    /// `rows` from `y` on, `bytes` from `x` on, up to kWidth.
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

HWY_INLINE void loadTemplate(const PatchPicture& p, int column, int row, Template& t) {
    const Row16 d16;
    const PatchRows rows(p, kCellSize * column - 3, kCellSize * row - 3, kPatch + 2, kPatch + 2);
    const auto middle = hn::Set(d16, 128), one = hn::Set(d16, 1);
    ProductSum aa, ax, ay, xx, xy, yy, sumA, sumX, sumY;
    for (int c = 0; c < kPatch; c += kRowLanes) {
        auto above = loadPixels(rows[0] + c + 1), here = loadPixels(rows[1] + c + 1);
        for (int r = 0; r < kPatch; ++r) {
            const std::uint8_t* line = rows[r + 1] + c;
            const auto below = loadPixels(rows[r + 2] + c + 1);
            const auto gx = hn::Sub(loadPixels(line + 2), loadPixels(line));
            const auto gy = hn::Sub(below, above);
            const auto a = hn::Sub(here, middle);
            hn::Store(a, d16, t.pixels + kPatch * r + c);
            hn::Store(gx, d16, t.gx + kPatch * r + c);
            hn::Store(gy, d16, t.gy + kPatch * r + c);
            sumA.add(a, one);
            sumX.add(gx, one);
            sumY.add(gy, one);
            aa.add(a, a);
            ax.add(a, gx);
            ay.add(a, gy);
            xx.add(gx, gx);
            xy.add(gx, gy);
            yy.add(gy, gy);
            above = here;
            here = below;
        }
    }
    float sums[12];
    sumLanes(sumA.total(), sumX.total(), sumY.total(), aa.total(), sums);
    sumLanes(ax.total(), ay.total(), xx.total(), xy.total(), sums + 4);
    sumLanes(yy.total(), yy.total(), yy.total(), yy.total(), sums + 8);
    t.mean = sums[0] / kPixels;
    t.variance = std::max(sums[3] - sums[0] * t.mean, 0.0F);
    t.sumG = {0.5F * sums[1], 0.5F * sums[2]};
    t.sumAG = Vector2{0.5F * sums[4], 0.5F * sums[5]} - t.mean * t.sumG;
    const float hxx = 0.25F * sums[6] + kDamping - t.sumG.x * t.sumG.x / kPixels;
    const float hxy = 0.25F * sums[7] - t.sumG.x * t.sumG.y / kPixels;
    const float hyy = 0.25F * sums[8] + kDamping - t.sumG.y * t.sumG.y / kPixels;
    const float scale = 1 / std::max(hxx * hyy - hxy * hxy, 1.0F);
    t.inverseXx = hyy * scale;
    t.inverseXy = -hxy * scale;
    t.inverseYy = hxx * scale;
}

/// Over the pixels of the patch: of the other picture, of its squares, of its product with the
/// template and with the gradients, in the units of their integers.
struct PatchSums {
    ProductSum bb, ab, xb, yb, b;

    HWY_INLINE PatchSums() : bb(), ab(), xb(), yb(), b() {}
    HWY_INLINE void add(const Template& t, int at, Vec16 value) {
        const Row16 d16;
        bb.add(value, value);
        ab.add(hn::Load(d16, t.pixels + at), value);
        xb.add(hn::Load(d16, t.gx + at), value);
        yb.add(hn::Load(d16, t.gy + at), value);
    }
};

HWY_INLINE Match matchOf(const Template& t, const PatchSums& s) {
    float sums[5];
    sumLanes(s.bb.total(), s.ab.total(), s.xb.total(), s.yb.total(), sums);
    sums[4] = static_cast<float>(hn::GetLane(hn::SumOfLanes(Sum32(), s.b.total())));
    const float b = sums[4] / kValue, mean = b / kPixels;
    const float varianceB = std::max(sums[0] / (kValue * kValue) - b * mean, 0.0F);
    const float covariance = sums[1] / kValue - t.mean * b;
    const float gain = std::sqrt((t.variance + kNoise) / (varianceB + kNoise));
    const Vector2 gb{sums[2] / (2 * kValue), sums[3] / (2 * kValue)};
    const float energy = t.variance + gain * gain * varianceB;
    Match m;
    m.descent = t.sumAG - gain * (gb - mean * t.sumG);
    m.cost = std::max(energy - 2 * gain * covariance, 0.0F) / (energy + kNoise);
    return m;
}

/// The template against a level, displaced by u pixels. Positions outside are held at the border.
HWY_INLINE Match compare(const Template& t, const PatchPicture& p, int column, int row, Vector2 u) {
    const Row16 d16;
    const float x = bounded(static_cast<float>(kCellSize * column - 2) + u.x, -7.0F,
                            static_cast<float>(p.width - 2));
    const float y = bounded(static_cast<float>(kCellSize * row - 2) + u.y, -7.0F,
                            static_cast<float>(p.height - 2));
    const float left = std::floor(x), top = std::floor(y);
    const PatchRows rows(p, static_cast<int>(left), static_cast<int>(top), kPatch + 1, kPatch + 1);
    const auto right = hn::Set(d16, static_cast<std::int16_t>((x - left) * 32767));
    const auto down = hn::Set(d16, static_cast<std::int16_t>((y - top) * 32767));
    const auto middle = hn::Set(d16, 128 << kValueBits);
    const auto between = [&](const std::uint8_t* from) HWY_ATTR {
        const auto here = loadPixels(from);
        const auto step = hn::ShiftLeft<kValueBits>(hn::Sub(loadPixels(from + 1), here));
        return hn::Add(hn::Sub(hn::ShiftLeft<kValueBits>(here), middle),
                       hn::MulFixedPoint15(step, right));
    };
    PatchSums sums;
    for (int c = 0; c < kPatch; c += kRowLanes) {
        auto above = between(rows[0] + c), columns = hn::Zero(d16);
        for (int r = 0; r < kPatch; ++r) {
            const auto below = between(rows[r + 1] + c);
            const auto v = hn::Add(above, hn::MulFixedPoint15(hn::Sub(below, above), down));
            columns = hn::Add(columns, v);  // eight times 4096 at most
            sums.add(t, kPatch * r + c, v);
            above = below;
        }
        sums.b.add(columns, hn::Set(d16, 1));
    }
    return matchOf(t, sums);
}

/// One Gauss-Newton step on the displacement, at most a pixel long.
HWY_INLINE Vector2 stepOf(const Template& t, Vector2 descent) {
    const Vector2 s{t.inverseXx * descent.x + t.inverseXy * descent.y,
                    t.inverseXy * descent.x + t.inverseYy * descent.y};
    const float squared = squaredLength(s);
    return squared > 1 ? (1 / std::sqrt(squared)) * s : s;
}

HWY_INLINE void put(const FlowPlanes& field, int column, int row, Vector2 u, float cost,
                    float texture) {
    const std::ptrdiff_t at = row * field.pitch + column;
    field.x[at] = u.x;
    field.y[at] = u.y;
    field.cost[at] = cost;
    field.texture[at] = texture;
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
