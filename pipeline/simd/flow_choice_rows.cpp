#include "pipeline/simd/flow_choice_rows.h"

#include "pipeline/engine/params/flow.h"
#include "pipeline/flow/cell_field.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/flow_choice_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// These must come after foreach_target.h, because they are compiled once per instruction set.
#include "pipeline/simd/cell_place-inl.h"
#include "pipeline/simd/still_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using I32 = hn::Rebind<std::int32_t, D>;

/// Returns the bits of three neighbours, which are in the row above, here or below.
HWY_INLINE hn::Vec<I32> StepsTo(const CellsAround& cells, const float* RowsAround::* which, int x,
                                int firstBit) {
    const D d;
    constexpr float kReach2 = params::kOtherSurface * params::kOtherSurface;
    const V ownX = hn::LoadU(d, cells.flowX.here + x), ownY = hn::LoadU(d, cells.flowY.here + x);
    auto bits = hn::Zero(I32());
    for (int i = 0; i < 3; ++i) {
        const int at = x + i - 1;
        const V dx = hn::Sub(hn::LoadU(d, cells.flowX.*which + at), ownX);
        const V dy = hn::Sub(hn::LoadU(d, cells.flowY.*which + at), ownY);
        const auto counts = hn::Gt(hn::LoadU(d, cells.compared.*which + at), Const(0));
        // The comparison is false if one of the vectors is NaN.
        const auto differs = hn::Gt(hn::MulAdd(dx, dx, hn::Mul(dy, dy)), Const(kReach2));
        const auto bit = hn::Set(I32(), 1 << (firstBit + i));
        bits =
            hn::Or(bits, hn::IfThenElseZero(hn::RebindMask(I32(), hn::And(counts, differs)), bit));
    }
    return bits;
}

void FindFlowSteps(const CellsAround& cells, int count, std::int32_t* neighbours) {
    const D d;
    for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(d))) {
        const auto counts = hn::Gt(hn::LoadU(d, cells.compared.here + x), Const(0));
        auto bits = hn::Zero(I32());
        if (!hn::AllFalse(d, counts)) {
            bits = hn::Or(StepsTo(cells, &RowsAround::above, x, 0),
                          hn::Or(StepsTo(cells, &RowsAround::here, x, 3),
                                 StepsTo(cells, &RowsAround::below, x, 6)));
            bits = hn::IfThenElseZero(hn::RebindMask(I32(), counts), bits);
        }
        hn::StoreU(bits, I32(), neighbours + x);
    }
}

/// Returns the still's luma as a video pixel sees it [grey levels minus 128]: the mean of 2x2
/// samples. `right` and `down`: distance from the cell's centre to that of the pixel [video px].
template <bool kOfLight>
HWY_INLINE V SeenAt(const StillPairs& still, const Place& place, float right, float down,
                    float light) {
    const StillBlocks blocks(still);
    V sum = Const(0), squares = Const(0);
    for (const float dy : {-0.25F, 0.25F})
        for (const float dx : {-0.25F, 0.25F}) {
            const Point p = PointNear(place, right + dx, down + dy);
            const Positions at = PositionsWithin(still.size, p.x, p.y);
            const V sample = MeanOfFour(blocks.scattered(at.x, at.y), at);
            sum = hn::Add(sum, sample);
            if constexpr (kOfLight) squares = hn::MulAdd(sample, sample, squares);
        }
    const V mean = hn::Mul(sum, Const(1.0F / 1024));
    if constexpr (kOfLight) {
        const V root = hn::Sqrt(hn::Mul(squares, Const(1.0F / (256 * 1024))));
        return hn::Add(hn::MulAdd(hn::Sub(root, mean), Const(light), mean), Const(-128));
    }
    return hn::Add(mean, Const(-128));
}

template <bool kOfLight>
void ErrorsOf(const LookUpParams& lookUp, const StillPairs& still, const FlowPairs& pairs,
              int first, float* errors) {
    const D d;
    const Point flow{hn::LoadU(d, pairs.flowX + first), hn::LoadU(d, pairs.flowY + first)};
    const Point flat{Const(0), Const(0)};
    const Place place = PlaceOf(lookUp, hn::LoadU(d, pairs.column + first),
                                hn::LoadU(d, pairs.row + first), flow, flat, flat);
    V error = Const(0);
    for (int j = 0; j < kCell; ++j) {
        hn::Vec<I16> v[4];
        hn::LoadInterleaved4(I16(), pairs.video[static_cast<std::size_t>(j)] + kCell * first, v[0],
                             v[1], v[2], v[3]);
        for (int i = 0; i < kCell; ++i) {
            const V seen = SeenAt<kOfLight>(still, place, static_cast<float>(i) - 1.5F,
                                            static_cast<float>(j) - 1.5F, pairs.light);
            const V off = hn::Sub(VideoAt(v[i]), seen);
            error = hn::MulAdd(off, off, error);
        }
    }
    const V outside = Const(std::numeric_limits<float>::quiet_NaN());
    hn::StoreU(hn::IfThenElse(place.isInside, error, outside), d, errors + first);
}

void CompareFlowPairs(const LookUpParams& lookUp, const StillPairs& still, const FlowPairs& pairs,
                      int count, float* errors) {
    const auto compare = pairs.light > 0 ? ErrorsOf<true> : ErrorsOf<false>;
    for (int first = 0; first < count; first += static_cast<int>(hn::Lanes(D())))
        compare(lookUp, still, pairs, first, errors);
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(FindFlowSteps);
HWY_EXPORT(CompareFlowPairs);

void findFlowSteps(const CellsAround& cells, int count, std::int32_t* neighbours) {
    HWY_DYNAMIC_DISPATCH(FindFlowSteps)(cells, count, neighbours);
}

void compareFlowPairs(const LookUpParams& lookUp, const StillPairs& still, const FlowPairs& pairs,
                      int count, float* errors) {
    HWY_DYNAMIC_DISPATCH(CompareFlowPairs)(lookUp, still, pairs, count, errors);
}

}  // namespace mfar::simd
#endif
