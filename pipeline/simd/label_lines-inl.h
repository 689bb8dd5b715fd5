// This header is included once per instruction set.
#include "pipeline/simd/label_lines.h"
#include "pipeline/simd/lanes-inl.h"

#if defined(MFAR_SIMD_LABEL_LINES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_LABEL_LINES_INL_H
#undef MFAR_SIMD_LABEL_LINES_INL_H
#else
#define MFAR_SIMD_LABEL_LINES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

template <class D, class V = hn::Vec<D>>
HWY_INLINE Points<V> placed(D d, const LabelLines& lines, V rayX, V rayY, V label) {
    const V s = hn::Mul(hn::Set(d, lines.perLabel), label), tz = hn::Set(d, lines.tz);
    const V x = hn::MulAdd(s, hn::NegMulAdd(rayX, tz, hn::Set(d, lines.tx)), rayX);
    const V y = hn::MulAdd(s, hn::NegMulAdd(rayY, tz, hn::Set(d, lines.ty)), rayY);
    const Points<V> p = projected(d, lines.lens, x, y);
    return {hn::Sub(p.x, hn::Set(d, lines.originX)), hn::Sub(p.y, hn::Set(d, lines.originY))};
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
