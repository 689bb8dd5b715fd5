// Finds where the still shows cells of the video. This header is included once per instruction set.
#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/still_pixel-inl.h"

#include <cstdint>

#if defined(MFAR_SIMD_CELL_PLACE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_CELL_PLACE_INL_H
#undef MFAR_SIMD_CELL_PLACE_INL_H
#else
#define MFAR_SIMD_CELL_PLACE_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using I16 = hn::Rebind<std::int16_t, D>;

/// Position of a cell in the still: that of the cell's centre, and its change per video pixel along
/// x and along y [still px]. `isInside`: the centre is inside the still.
struct Place {
    Point centre, alongX, alongY;
    hn::Mask<D> isInside;
};

/// `column` and `row`: of the cells. `flow`: their flow. flowAlongX, flowAlongY: change of the flow
/// per pixel along x and along y.
HWY_INLINE Place PlaceOf(const LookUpParams& lookUp, V column, V row, const Point& flow,
                         const Point& flowAlongX, const Point& flowAlongY) {
    constexpr float kMiddle = 1.5F;  // centre of a cell, from its first pixel
    const Point p{hn::Add(hn::MulAdd(column, Const(kCell), Const(kMiddle)), flow.x),
                  hn::Add(hn::MulAdd(row, Const(kCell), Const(kMiddle)), flow.y)};
    const auto moved = [&](V dx, V dy) HWY_ATTR {
        return StillPixel(lookUp, hn::MulAdd(Const(kCell), dx, p.x),
                          hn::MulAdd(Const(kCell), dy, p.y));
    };
    const Point at = StillPixel(lookUp, p.x, p.y);
    const Point right = moved(hn::Add(Const(1), flowAlongX.x), flowAlongX.y);
    const Point below = moved(flowAlongY.x, hn::Add(Const(1), flowAlongY.y));
    const auto along = [&](const Point& to) HWY_ATTR {
        return Point{hn::Mul(hn::Sub(to.x, at.x), Const(1.0F / kCell)),
                     hn::Mul(hn::Sub(to.y, at.y), Const(1.0F / kCell))};
    };
    const auto within = [](V v, float size) HWY_ATTR {
        return hn::And(hn::Ge(v, Const(0)), hn::Le(v, Const(size - 1)));
    };
    return {at, along(right), along(below),
            hn::And(within(at.x, lookUp.still.width), within(at.y, lookUp.still.height))};
}

/// Returns the position in the still of a point near a cell. `right` and `down`: distance from the
/// cell's centre [video px].
HWY_INLINE Point PointNear(const Place& place, float right, float down) {
    const auto along = [&](V centre, V perX, V perY) HWY_ATTR {
        return hn::MulAdd(Const(right), perX, hn::MulAdd(Const(down), perY, centre));
    };
    return {along(place.centre.x, place.alongX.x, place.alongY.x),
            along(place.centre.y, place.alongX.y, place.alongY.y)};
}

/// Converts luma of the video [1/8 grey level] to grey levels minus 128: small numbers have small
/// rounding errors.
HWY_INLINE V VideoAt(hn::Vec<I16> eighths) {
    const V wide = hn::ConvertTo(D(), hn::PromoteTo(hn::Rebind<std::int32_t, D>(), eighths));
    return hn::MulAdd(wide, Const(1.0F / 8), Const(-128));
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
