// Projects vectors of points to pixels. This header is included once per instruction set.
#include "pipeline/simd/point_lens.h"

#include <hwy/highway.h>

#if defined(MFAR_SIMD_POINT_LENS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_POINT_LENS_INL_H
#undef MFAR_SIMD_POINT_LENS_INL_H
#else
#define MFAR_SIMD_POINT_LENS_INL_H
#endif

#include "pipeline/simd/distortion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Triples {
    V x, y, z;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Triples<V> Transformed(D d, const PointTransform& T, const Triples<V>& p) {
    const auto row = [&](const float* r) HWY_ATTR {
        const V xy = hn::MulAdd(hn::Set(d, r[0]), p.x, hn::Mul(hn::Set(d, r[1]), p.y));
        return hn::Add(xy, hn::MulAdd(hn::Set(d, r[2]), p.z, hn::Set(d, r[3])));
    };
    return {row(T.rows[0]), row(T.rows[1]), row(T.rows[2])};
}

/// Returns the pixels (x, y) of points with z > 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Triples<V> PixelsOf(D d, const PointLens& lens, const Triples<V>& p) {
    const auto set = [d](float v) HWY_ATTR { return hn::Set(d, v); };
    const V r2 = hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y));
    const V reach = hn::Mul(p.z, set(lens.rim));
    const auto within = hn::Gt(hn::Mul(reach, reach), r2);
    const bool all = hn::AllTrue(d, within);
    V scale = hn::Div(set(1), p.z);
    if (!all) {
        const V r = hn::Max(hn::Sqrt(r2), set(1e-12F));
        scale = hn::IfThenElse(within, scale, hn::Div(set(lens.rim), r));
    }
    const V x = hn::Mul(p.x, scale), y = hn::Mul(p.y, scale);
    const V q = hn::MulAdd(x, x, hn::Mul(y, y));
    auto [u, v] = distorted(d, lens, x, y, q);
    if (!all) {
        const V beyond = set(lens.rimRadial);
        u = hn::IfThenElse(within, u, hn::MulAdd(beyond, hn::Sub(hn::Div(p.x, p.z), x), u));
        v = hn::IfThenElse(within, v, hn::MulAdd(beyond, hn::Sub(hn::Div(p.y, p.z), y), v));
    }
    return {hn::MulAdd(u, set(lens.fx), set(lens.cx)), hn::MulAdd(v, set(lens.fy), set(lens.cy)),
            p.z};
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
