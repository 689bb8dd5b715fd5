// SIMD functions for pixels with inverse depth. This header is included once per instruction set.
#include "base/image_view.h"
#include "pipeline/simd/lanes-inl.h"

#if defined(MFAR_SIMD_DEPTH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_DEPTH_LANES_INL_H
#undef MFAR_SIMD_DEPTH_LANES_INL_H
#else
#define MFAR_SIMD_DEPTH_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

/// InverseDepthField::isSound() for a vector of pixels.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> isSound(D d, V inverseDepth, V variance) {
    const auto isDepth =
        hn::And(hn::Ge(inverseDepth, hn::Zero(d)), hn::Lt(inverseDepth, hn::Set(d, 1e15F)));
    const auto isVariance =
        hn::And(hn::Gt(variance, hn::Set(d, 1e-30F)), hn::Lt(variance, hn::Set(d, 1e30F)));
    return hn::And(isDepth, isVariance);
}

template <class V>
struct RangeOf {
    V low, high;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE RangeOf<V> rangeOver(D d, const float* low, const float* high, std::ptrdiff_t pitch,
                                int rows) {
    RangeOf<V> out{hn::LoadU(d, low), hn::LoadU(d, high)};
    for (int j = 1; j < rows; ++j) {
        out.low = hn::Min(out.low, hn::LoadU(d, low + j * pitch));
        out.high = hn::Max(out.high, hn::LoadU(d, high + j * pitch));
    }
    return out;
}

template <class D>
struct Turn {
    HWY_INLINE Turn(D tag, const float* rowMajor) : d(tag), r(rowMajor) {}
    template <class V>
    HWY_INLINE V component(int k, V x, V y, V z) const {
        const float* row = r + 3L * k;
        return hn::MulAdd(hn::Set(d, row[0]), x,
                          hn::MulAdd(hn::Set(d, row[1]), y, hn::Mul(hn::Set(d, row[2]), z)));
    }
    D d;
    const float* r;
};

/// The column and row of the pixel that contains each point, as in EpipolarLens::pixelAt(). Both
/// are 0 for points outside the picture, where `inside` is false.
template <class D, class V = hn::Vec<D>>
struct PixelOf {
    hn::Vec<hn::RebindToSigned<D>> column, row;
    hn::Mask<D> inside;

    HWY_INLINE PixelOf(D d, const Points<V>& p, Size size) {
        const hn::RebindToSigned<D> dInt;
        const V half = hn::Set(d, 0.5F), zero = hn::Zero(d);
        const V u = hn::Add(p.x, half), v = hn::Add(p.y, half);
        const V width = hn::Set(d, static_cast<float>(size.width));
        const V height = hn::Set(d, static_cast<float>(size.height));
        inside = hn::And(hn::And(hn::Ge(u, zero), hn::Ge(v, zero)),
                         hn::And(hn::Lt(u, width), hn::Lt(v, height)));
        column = hn::ConvertTo(dInt, hn::IfThenElseZero(inside, u));
        row = hn::ConvertTo(dInt, hn::IfThenElseZero(inside, v));
    }
};

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
