// Functions that several kernels use. This header is included once per instruction set.
#include "pipeline/simd/lens.h"

#include <cstddef>
#include <hwy/highway.h>

#if defined(MFAR_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_LANES_INL_H
#undef MFAR_SIMD_LANES_INL_H
#else
#define MFAR_SIMD_LANES_INL_H
#endif

#include "pipeline/simd/distortion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Splits the elements 0 to `count` - 1 of arrays into vectors, and calls body(tag, i) for each
/// vector; `i` is the index of its first element. The last vector can overlap the previous one, so
/// the body must not change its input. If a vector has more than `count` lanes, the body is called
/// for each single element.
template <class D, class Body>
HWY_INLINE void forLanes(D d, std::size_t count, const Body& body) {
    const std::size_t lanes = hn::Lanes(d);
    if (count < lanes) {
        const hn::CappedTag<hn::TFromD<D>, 1> one;
        for (std::size_t i = 0; i < count; ++i)
            body(one, i);
        return;
    }
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        body(d, i);
    if (i < count) body(d, count - lanes);
}

/// EpipolarLens::project() for a vector of rays.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Points<V> projected(D d, const Lens& lens, V x, V y) {
    const auto set = [d](float v) HWY_ATTR { return hn::Set(d, v); };
    V q = hn::MulAdd(x, x, hn::Mul(y, y));
    const V rim = set(lens.rim2);
    // Rays with NaN also take this branch, because q <= rim is false for NaN. They stay NaN.
    if (!hn::AllTrue(d, hn::Le(q, rim))) {
        const V c = hn::Sqrt(hn::Div(rim, hn::Max(q, rim)));
        x = hn::Mul(x, c);
        y = hn::Mul(y, c);
        q = hn::Min(q, rim);
    }
    const Points<V> bent = distorted(d, lens, x, y, q);
    return {hn::MulAdd(set(lens.fx), bent.x, set(lens.cx)),
            hn::MulAdd(set(lens.fy), bent.y, set(lens.cy))};
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
