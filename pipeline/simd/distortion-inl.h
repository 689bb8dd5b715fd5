// Lens distortion for vectors of rays. This header is included once per instruction set.
#include <hwy/highway.h>

#if defined(MFAR_SIMD_DISTORTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_DISTORTION_INL_H
#undef MFAR_SIMD_DISTORTION_INL_H
#else
#define MFAR_SIMD_DISTORTION_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Points {
    V x, y;
};

/// Applies radial and tangential distortion to rays (x, y, 1); the result is in focal lengths. `q`
/// must be x^2 + y^2. `Model` must have the members k1, k2, k3, p1 and p2. Source: Brown,
/// Close-range camera calibration, 1971.
template <class D, class Model, class V = hn::Vec<D>>
HWY_INLINE Points<V> distorted(D d, const Model& lens, V x, V y, V q) {
    const auto set = [d](float v) HWY_ATTR { return hn::Set(d, v); };
    V radial = hn::MulAdd(q, set(lens.k3), set(lens.k2));
    radial = hn::MulAdd(q, radial, set(lens.k1));
    radial = hn::MulAdd(q, radial, set(1));
    const V x2 = hn::Add(x, x), y2 = hn::Add(y, y), xy = hn::Mul(x2, y);
    const V p1 = set(lens.p1), p2 = set(lens.p2);
    const V u = hn::MulAdd(p2, hn::MulAdd(x2, x, q), hn::Mul(p1, xy));
    const V v = hn::MulAdd(p1, hn::MulAdd(y2, y, q), hn::Mul(p2, xy));
    return {hn::MulAdd(x, radial, u), hn::MulAdd(y, radial, v)};
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
