#include "pipeline/simd/still_look_up.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/still_look_up.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/still_pixel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A point with NaN is outside the picture.
HWY_INLINE hn::Mask<D> Inside(const LensParams& lens, Point p) {
    const V zero = hn::Zero(D());
    const auto x = hn::And(hn::Ge(p.x, zero), hn::Le(p.x, Const(lens.width - 1)));
    return hn::And(x, hn::And(hn::Ge(p.y, zero), hn::Le(p.y, Const(lens.height - 1))));
}

// Clamps to [`least`, `most`]; NaN becomes `least`.
HWY_INLINE V Clamp(V value, float least, float most) {
    const V low = Const(least);
    return hn::IfThenElse(hn::Gt(value, low), hn::Min(value, Const(most)), low);
}

struct Bilinear {
    hn::Vec<hn::RebindToSigned<D>> first, second;
    V share;
};

HWY_INLINE Bilinear Between(V position, float last) {
    const hn::RebindToSigned<D> di;
    const V floor = hn::Floor(position);
    return {hn::ConvertTo(di, Clamp(floor, 0, last)),
            hn::ConvertTo(di, Clamp(hn::Add(floor, Const(1)), 0, last)), hn::Sub(position, floor)};
}

HWY_INLINE V Mix(V a, V b, V share) {
    return hn::MulAdd(hn::Sub(b, a), share, a);
}

/// Returns the two-way error [video px]. The flow leads from a cell to `q`; the backward field at
/// `q` should lead back. The error is the length of the sum of these two vectors.
HWY_INLINE V TwoWayError(const BackwardCells& backward, Point q, V flowX, V flowY) {
    const D d;
    const hn::RebindToSigned<D> di;
    const V perCell = Const(1 / (4 * backward.scale)), half = Const(0.5F);
    const auto at = [&](V p, int count) HWY_ATTR {
        const V position = hn::Sub(hn::Mul(hn::Add(p, half), perCell), half);
        return Between(position, static_cast<float>(count - 1));
    };
    const Bilinear x = at(q.x, backward.columns), y = at(q.y, backward.rows);
    const auto pitch = hn::Set(di, static_cast<std::int32_t>(backward.pitch));
    const auto* field = reinterpret_cast<const float*>(backward.field);
    const auto look = [&](int part) HWY_ATTR {
        const auto atCell = [&](auto column, auto row) HWY_ATTR {
            const auto cell = hn::Add(hn::Mul(row, pitch), column);
            return hn::GatherIndex(d, field + part, hn::ShiftLeft<2>(cell));
        };
        return Mix(Mix(atCell(x.first, y.first), atCell(x.second, y.first), x.share),
                   Mix(atCell(x.first, y.second), atCell(x.second, y.second), x.share), y.share);
    };
    const V scale = Const(backward.scale);
    const V dx = hn::MulAdd(scale, look(0), flowX), dy = hn::MulAdd(scale, look(1), flowY);
    return hn::Sqrt(hn::MulAdd(dx, dx, hn::Mul(dy, dy)));
}

void LookUpCells(const LookUpParams& lookUp, const BackwardCells& backward, const LookUpRow& row) {
    const D d;
    constexpr float kFarthest = params::kFarthestOffset;
    const float centreY = 4 * static_cast<float>(row.row) + 1.5F;
    HWY_ALIGN std::array<float, kChunk> errors{};
    for (int chunk = 0; chunk < row.count; chunk += kChunk) {
        const int count = std::min(kChunk, row.count - chunk);
        for (int i = 0; backward.errors != nullptr && i < count; ++i)
            errors[i] = backward.errors[chunk + i].error;
        for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
            const int cell = chunk + i;
            const V centre =
                hn::MulAdd(hn::Iota(d, static_cast<float>(cell)), Const(4), Const(1.5F));
            const V flowX = hn::LoadU(d, row.flowX + cell), flowY = hn::LoadU(d, row.flowY + cell);
            const Point q{hn::Add(centre, flowX), hn::Add(Const(centreY), flowY)};
            const Point inStill = StillPixel(lookUp, q.x, q.y);
            const V error = backward.errors != nullptr ? hn::Load(d, &errors[i])
                                                       : TwoWayError(backward, q, flowX, flowY);
            const auto agrees =
                hn::And(hn::And(Inside(lookUp.video, q), Inside(lookUp.still, inStill)),
                        hn::Lt(error, Const(params::kTwoWayAlpha)));
            const V confidence = hn::NegMulAdd(error, Const(1 / params::kTwoWayAlpha), Const(1));
            hn::StoreU(hn::IfThenElseZero(agrees, confidence), d, row.confidence + cell);
            const V x =
                hn::MulAdd(hn::Add(centre, Const(0.5F)), Const(lookUp.scaleX), Const(-0.5F));
            const V y = Const((centreY + 0.5F) * lookUp.scaleY - 0.5F);
            hn::StoreU(Clamp(hn::Sub(inStill.x, x), -kFarthest, kFarthest), d, row.lookX + cell);
            hn::StoreU(Clamp(hn::Sub(inStill.y, y), -kFarthest, kFarthest), d, row.lookY + cell);
        }
    }
}

void SplitFlow(const FlowCell* cells, int count, float* x, float* y) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int i = 0;
    for (; i + lanes <= count; i += lanes) {
        V a, b, cost, texture;
        hn::LoadInterleaved4(d, &cells[i].x, a, b, cost, texture);
        hn::StoreU(a, d, x + i);
        hn::StoreU(b, d, y + i);
    }
    for (; i < count; ++i) {
        x[i] = cells[i].x;
        y[i] = cells[i].y;
    }
}

void HalveFlow(const float* upper, const float* lower, int count, float* out) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int i = 0;
    for (; i + lanes <= count; i += lanes) {
        V a, b, c, e;
        hn::LoadInterleaved2(d, upper + 2 * i, a, b);
        hn::LoadInterleaved2(d, lower + 2 * i, c, e);
        const V sum = hn::Add(hn::Add(hn::Add(a, b), c), e);
        hn::StoreU(hn::Mul(sum, Const(0.125F)), d, out + i);
    }
    for (; i < count; ++i)
        out[i] = 0.125F * (upper[2 * i] + upper[2 * i + 1] + lower[2 * i] + lower[2 * i + 1]);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(LookUpCells);
HWY_EXPORT(SplitFlow);
HWY_EXPORT(HalveFlow);

LensParams::LensParams(const CameraModel& camera)
    : params::Lens(lensOf(camera)), width(static_cast<float>(camera.size.width)),
      height(static_cast<float>(camera.size.height)),
      distorts(std::ranges::any_of(camera.distortion, [](double k) { return k != 0; })) {}

LookUpParams::LookUpParams(const StereoRig& rig)
    : video(rig.video), still(rig.still), rotation(rowsOf(rig.T_still_video.rotation)),
      scaleX(static_cast<float>(rig.still.fx / rig.video.fx)),
      scaleY(static_cast<float>(rig.still.fy / rig.video.fy)) {}

void lookUpCells(const LookUpParams& lookUp, const BackwardCells& backward, const LookUpRow& row) {
    HWY_DYNAMIC_DISPATCH(LookUpCells)(lookUp, backward, row);
}

void splitFlow(const FlowCell* cells, int count, float* x, float* y) {
    HWY_DYNAMIC_DISPATCH(SplitFlow)(cells, count, x, y);
}

void halveFlow(const float* upper, const float* lower, int count, float* out) {
    HWY_DYNAMIC_DISPATCH(HalveFlow)(upper, lower, count, out);
}

}  // namespace mfar::simd
#endif
