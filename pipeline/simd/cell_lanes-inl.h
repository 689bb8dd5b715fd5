// Functions on vectors of cells that several kernels use. This header is included once per
// instruction set.
#include "pipeline/simd/cell_weights.h"

#include <hwy/highway.h>

#if defined(MFAR_SIMD_CELL_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_CELL_LANES_INL_H
#undef MFAR_SIMD_CELL_LANES_INL_H
#else
#define MFAR_SIMD_CELL_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Cells = hn::CappedTag<float, 16>;

/// Returns 0 up to `low`, 1 from `high` on, and a smooth transition between them, like GLSL's
/// smoothstep.
HWY_INLINE hn::Vec<Cells> smoothStep(float low, float high, hn::Vec<Cells> value) {
    const Cells d;
    const auto unit = hn::Mul(hn::Sub(value, hn::Set(d, low)), hn::Set(d, 1 / (high - low)));
    const auto t = hn::Max(hn::Min(unit, hn::Set(d, 1.0F)), hn::Zero(d));
    return hn::Mul(hn::Mul(t, t), hn::NegMulAdd(hn::Set(d, 2.0F), t, hn::Set(d, 3.0F)));
}

/// Returns the weighted means of 3x3 cells around the cells from `x` on.
HWY_INLINE hn::Vec<Cells> smoothed(const RowsAround& rows, int x) {
    const Cells d;
    const auto two = hn::Set(d, 2.0F);
    const auto column = [&](int at) HWY_ATTR {
        return hn::MulAdd(two, hn::LoadU(d, rows.here + at),
                          hn::Add(hn::LoadU(d, rows.above + at), hn::LoadU(d, rows.below + at)));
    };
    return hn::Mul(hn::MulAdd(two, column(x), hn::Add(column(x - 1), column(x + 1))),
                   hn::Set(d, 1.0F / 16));
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
