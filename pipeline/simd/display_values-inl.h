// Conversion between display (sRGB, levels 0 to 255) and linear values (0 to 1) for vectors of
// pixels. This header is included once per instruction set.
#if defined(MFAR_SIMD_DISPLAY_VALUES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_DISPLAY_VALUES_INL_H
#undef MFAR_SIMD_DISPLAY_VALUES_INL_H
#else
#define MFAR_SIMD_DISPLAY_VALUES_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

namespace hw = hwy::HWY_NAMESPACE;

/// Returns the linear value of a display level. Its error, converted to display levels, is below
/// 0.06.
template <class D>
HWY_INLINE hw::Vec<D> LinearOf(D d, hw::Vec<D> byte) {
    const auto x = hw::Mul(byte, hw::Set(d, 1.0F / 255));
    // Approximates ((x + 0.055) / 1.055)^2.4. (Remez algorithm: the largest error, in display
    // levels, is as small as possible.)
    auto high = hw::MulAdd(x, hw::Set(d, -0.116793521F), hw::Set(d, 0.526517236F));
    high = hw::MulAdd(x, high, hw::Set(d, 0.560367981F));
    high = hw::MulAdd(x, high, hw::Set(d, 0.0284049498F));
    high = hw::MulAdd(x, high, hw::Set(d, 0.00104623352F));
    const auto low = hw::Mul(x, hw::Set(d, 1 / 12.92F));
    return hw::IfThenElse(hw::Lt(x, hw::Set(d, 0.04045F)), low, high);
}

/// Returns the display level [0, 255] of a linear value, without rounding it to a whole number. The
/// linear value is first clamped to [0, 1].
template <class D>
HWY_INLINE hw::Vec<D> SrgbLevel(D d, hw::Vec<D> linear) {
    const auto x = hw::Min(hw::Max(linear, hw::Zero(d)), hw::Set(d, 1));
    const auto s = hw::Sqrt(x);
    // Approximates 255 (1.055 s^(2 / 2.4) - 0.055) with an error below 0.09 display levels (Remez
    // approximation).
    auto high = hw::MulAdd(s, hw::Set(d, 132.00984F), hw::Set(d, -414.30241F));
    high = hw::MulAdd(s, high, hw::Set(d, 518.32418F));
    high = hw::MulAdd(s, high, hw::Set(d, -357.82060F));
    high = hw::MulAdd(s, high, hw::Set(d, 387.10107F));
    high = hw::MulAdd(s, high, hw::Set(d, -10.229407F));
    const auto low = hw::Mul(x, hw::Set(d, 12.92F * 255));
    return hw::IfThenElse(hw::Lt(x, hw::Set(d, 0.0031308F)), low, high);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
