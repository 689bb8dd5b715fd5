// Finds where the still shows infinitely distant points of the video; see rig.glsl. This header is
// included once per instruction set.
#include "pipeline/engine/params/luma.h"
#include "pipeline/simd/still_look_up.h"

#include <hwy/highway.h>

#if defined(MFAR_SIMD_STILL_PIXEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_STILL_PIXEL_INL_H
#undef MFAR_SIMD_STILL_PIXEL_INL_H
#else
#define MFAR_SIMD_STILL_PIXEL_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kChunk = 16;
using D = hn::CappedTag<float, kChunk>;
using V = hn::Vec<D>;

struct Point {
    V x, y;
};

HWY_INLINE V Const(float value) {
    return hn::Set(D(), value);
}

HWY_INLINE Point Distort(const LensParams& lens, Point p) {
    const V xx = hn::Mul(p.x, p.x), yy = hn::Mul(p.y, p.y), xy = hn::Mul(p.x, p.y);
    const V r2 = hn::Add(xx, yy);
    const V inner = hn::MulAdd(r2, Const(lens.k3), Const(lens.k2));
    const V radial = hn::MulAdd(r2, hn::MulAdd(r2, inner, Const(lens.k1)), Const(1));
    const V twiceXy = hn::Add(xy, xy);
    const V acrossX = hn::MulAdd(Const(2), xx, r2), acrossY = hn::MulAdd(Const(2), yy, r2);
    const V x = hn::MulAdd(Const(lens.p1), twiceXy, hn::Mul(Const(lens.p2), acrossX));
    const V y = hn::MulAdd(Const(lens.p1), acrossY, hn::Mul(Const(lens.p2), twiceXy));
    return {hn::MulAdd(p.x, radial, x), hn::MulAdd(p.y, radial, y)};
}

HWY_INLINE V StepTo(V target, V at) {
    return hn::Max(hn::Min(hn::Sub(target, at), Const(0.5F)), Const(-0.5F));
}

// Returns the ray of a pixel. The lens distortion is removed by fixed-point iteration, as in
// camera.glsl, but only until all lanes have converged.
HWY_INLINE Point Unproject(const LensParams& lens, V x, V y) {
    constexpr float kAtRest = 3e-7F;  // 0.001 px at a focal length of 3000 px
    const Point target{hn::Mul(hn::Sub(x, Const(lens.cx)), Const(1 / lens.fx)),
                       hn::Mul(hn::Sub(y, Const(lens.cy)), Const(1 / lens.fy))};
    Point ray = target;
    for (int i = 0; lens.distorts && i < params::kUndistortSteps; ++i) {
        const Point at = Distort(lens, ray);
        const V dx = StepTo(target.x, at.x), dy = StepTo(target.y, at.y);
        ray = {hn::Add(ray.x, dx), hn::Add(ray.y, dy)};
        const V step = hn::Max(hn::Abs(dx), hn::Abs(dy));
        if (hn::AllTrue(D(), hn::Le(step, Const(kAtRest)))) break;
    }
    return ray;
}

// Returns the position in the still of the infinitely distant point that the video shows at pixel
// (x, y). The position is far outside the still if the point is not in front of the still camera.
HWY_INLINE Point StillPixel(const LookUpParams& lookUp, V x, V y) {
    const Point ray = Unproject(lookUp.video, x, y);
    const auto turned = [&](int row) HWY_ATTR {
        const auto& r = lookUp.rotation[row];
        return hn::MulAdd(Const(r.x), ray.x, hn::MulAdd(Const(r.y), ray.y, Const(r.z)));
    };
    const V z = turned(2);
    const auto ahead = hn::Gt(z, Const(params::kLeastTurnedDepth));
    const V inverseDepth = hn::Div(Const(1), hn::IfThenElse(ahead, z, Const(1)));
    Point at{hn::Mul(turned(0), inverseDepth), hn::Mul(turned(1), inverseDepth)};
    if (lookUp.still.distorts) at = Distort(lookUp.still, at);
    const V far = Const(params::kFarOutside);
    return {hn::IfThenElse(ahead, hn::MulAdd(at.x, Const(lookUp.still.fx), Const(lookUp.still.cx)),
                           far),
            hn::IfThenElse(ahead, hn::MulAdd(at.y, Const(lookUp.still.fy), Const(lookUp.still.cy)),
                           far)};
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
