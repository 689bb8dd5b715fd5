#include "pipeline/simd/cell_flow_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/cell_flow_rows.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/depth_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

constexpr float kCell = 4;

void CellDepths(const float* upper, const float* lower, std::size_t count, float* out) {
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        hn::Vec<decltype(d)> a, b, c, e, outer, last;
        hn::LoadInterleaved4(d, upper + 4 * i, outer, a, b, last);
        hn::LoadInterleaved4(d, lower + 4 * i, outer, c, e, last);
        const auto low = hn::Max(hn::Min(a, b), hn::Min(c, e));
        const auto high = hn::Min(hn::Max(a, b), hn::Max(c, e));
        hn::StoreU(hn::Mul(hn::Set(d, 0.5F), hn::Add(low, high)), d, out + i);
    });
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE Points<V> endOf(D d, const FlowEnds& ends, V rx, V ry, V s) {
    const auto& move = ends.motion.move;
    const V one = hn::Set(d, 1), tz = hn::Set(d, move[2]), nowhere = hn::Set(d, ends.nowhere);
    const V x = hn::MulAdd(s, hn::NegMulAdd(rx, tz, hn::Set(d, move[0])), rx);
    const V y = hn::MulAdd(s, hn::NegMulAdd(ry, tz, hn::Set(d, move[1])), ry);
    const Turn<D> turn(d, ends.motion.turn.data());
    const V z = turn.component(2, x, y, one), inverse = hn::Div(one, z);
    const auto q = projected(d, ends.lens, hn::Mul(turn.component(0, x, y, one), inverse),
                             hn::Mul(turn.component(1, x, y, one), inverse));
    const auto isNear = hn::And(hn::Lt(hn::Abs(q.x), nowhere), hn::Lt(hn::Abs(q.y), nowhere));
    const auto shown = hn::And(hn::Gt(z, hn::Set(d, ends.nearPlane)), isNear);
    return {hn::IfThenElse(shown, q.x, nowhere), hn::IfThenElse(shown, q.y, nowhere)};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE Points<V> loadVectors(D d, const CellVector* from) {
    // A variable of type Points is not used here, because its default constructor would not be
    // compiled for this instruction set.
    V x, y, c, e;
    hn::LoadInterleaved4(d, from->data(), x, y, c, e);
    return {x, y};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE void storeVectors(D d, V x, V y, CellVector* to) {
    hn::StoreInterleaved4(x, y, hn::Zero(d), hn::Zero(d), d, to->data());
}

void CellFlow(const FlowEnds& ends, const CellRow& row, const float* s, CellVector* flow) {
    forLanes(hn::ScalableTag<float>(), row.count, [&](auto d, std::size_t i) HWY_ATTR {
        const auto q = endOf(d, ends, hn::LoadU(d, row.raysX + i), hn::LoadU(d, row.raysY + i),
                             hn::LoadU(d, s + i));
        storeVectors(d, hn::Sub(q.x, hn::LoadU(d, row.middlesX + i)),
                     hn::Sub(q.y, hn::Set(d, row.middleY)), flow + i);
    });
}

template <class D>
HWY_INLINE void storeCells(D d, const Points<hn::Vec<D>>& p, hn::Mask<D> valid, Size cells,
                           std::int32_t* to) {
    const hn::RebindToSigned<D> dInt;
    const PixelOf<D> at(d, p, cells);
    const auto cell = hn::Add(hn::Mul(at.row, hn::Set(dInt, cells.width)), at.column);
    const auto landed = hn::RebindMask(dInt, hn::And(valid, at.inside));
    hn::StoreU(hn::IfThenElse(landed, cell, hn::Set(dInt, -1)), dInt, to);
}

void CellLandings(const CellVector* flow, int j, Size cells, std::int32_t* landing) {
    const auto count = static_cast<std::size_t>(cells.width);
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        const auto u = loadVectors(d, flow + i);
        const auto perCell = hn::Set(d, 1 / kCell);
        const auto x = hn::MulAdd(u.x, perCell, hn::Iota(d, static_cast<float>(i)));
        const auto y = hn::MulAdd(u.y, perCell, hn::Set(d, static_cast<float>(j)));
        storeCells(d, {x, y}, hn::Eq(x, x), cells, landing + i);
    });
}

void CellsHidden(const std::int32_t* landing, const float* nearest, const float* s,
                 const HiddenRule& rule, std::size_t count, CellVector* out) {
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        const hn::RebindToSigned<decltype(d)> dInt;
        const auto to = hn::LoadU(dInt, landing + i);
        const auto first = hn::GatherIndex(d, nearest, hn::Max(to, hn::Zero(dInt)));
        const auto apart = hn::Sub(first, hn::LoadU(d, s + i));
        const auto error =
            hn::MulSub(apart, hn::Set(d, rule.pixelsPerUnit), hn::Set(d, rule.slope));
        const auto nowhere = hn::Set(d, rule.nowhere), zero = hn::Zero(d);
        const auto landed = hn::RebindMask(d, hn::Gt(to, hn::Set(dInt, -1)));
        const auto held = hn::Min(hn::Max(error, zero), nowhere);
        storeVectors(d, hn::IfThenElse(landed, held, nowhere), zero, out + i);
    });
}

void AlignCells(const FlowEnds& ends, const CellRow& row, const CellVector* flow,
                const CellVector* start, float step, float leastWay, float* s) {
    const auto align = [&](auto d, std::size_t i, float* to) HWY_ATTR {
        const auto rx = hn::LoadU(d, row.raysX + i), ry = hn::LoadU(d, row.raysY + i);
        const auto at = hn::LoadU(d, s + i), ahead = hn::Set(d, step);
        const auto on = endOf(d, ends, rx, ry, at);
        const auto next = endOf(d, ends, rx, ry, hn::Add(at, ahead));
        const auto wayX = hn::Sub(next.x, on.x), wayY = hn::Sub(next.y, on.y);
        const auto square = hn::MulAdd(wayX, wayX, hn::Mul(wayY, wayY));
        const auto wanted = loadVectors(d, flow + i), now = loadVectors(d, start + i);
        const auto offX = hn::Sub(wanted.x, now.x), offY = hn::Sub(wanted.y, now.y);
        const auto along = hn::MulAdd(offX, wayX, hn::Mul(offY, wayY));
        const auto tells = hn::Gt(square, hn::Set(d, leastWay * leastWay));
        const auto moved = hn::MulAdd(ahead, hn::Div(along, square), at);
        hn::StoreU(hn::IfThenElse(tells, moved, at), d, to);
    };
    // `s` is changed in place, so the last vector must not overlap the previous one.
    const hn::ScalableTag<float> d;
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= row.count; i += hn::Lanes(d))
        align(d, i, s + i);
    for (; i < row.count; ++i)
        align(hn::CappedTag<float, 1>(), i, s + i);
}

void PredictCells(const CellMotion& m, const float* raysX, const float* raysY, const float* s,
                  std::size_t count, Size cells, std::int32_t* landing, float* moved) {
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        const auto set = [d](float v) HWY_ATTR { return hn::Set(d, v); };
        const auto at = hn::LoadU(d, s + i), one = set(1), least = set(m.nearPlane);
        const auto depth = hn::NegMulAdd(at, set(m.lastZ), one);
        const auto x = hn::Mul(hn::LoadU(d, raysX + i), depth);
        const auto y = hn::Mul(hn::LoadU(d, raysY + i), depth);
        const Turn<decltype(d)> turn(d, m.motion.turn.data());
        const auto component = [&](int k) HWY_ATTR {
            return hn::MulAdd(at, set(m.motion.move[k]), turn.component(k, x, y, depth));
        };
        const auto z = component(2), whole = hn::MulAdd(at, set(m.nextZ), z);
        const auto inverse = hn::Div(one, z);
        const auto p =
            projected(d, m.lens, hn::Mul(component(0), inverse), hn::Mul(component(1), inverse));
        storeCells(d, p, hn::And(hn::Gt(z, least), hn::Gt(whole, least)), cells, landing + i);
        hn::StoreU(hn::Mul(hn::Div(at, whole), set(m.perUnit)), d, moved + i);
    });
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(CellDepths);
HWY_EXPORT(CellFlow);
HWY_EXPORT(CellLandings);
HWY_EXPORT(CellsHidden);
HWY_EXPORT(AlignCells);
HWY_EXPORT(PredictCells);

void cellDepths(const float* upper, const float* lower, std::size_t count, float* out) {
    HWY_DYNAMIC_DISPATCH(CellDepths)(upper, lower, count, out);
}

void cellFlow(const FlowEnds& ends, const CellRow& row, const float* s, CellVector* flow) {
    HWY_DYNAMIC_DISPATCH(CellFlow)(ends, row, s, flow);
}

void cellLandings(const CellVector* flow, int j, Size cells, std::int32_t* landing) {
    HWY_DYNAMIC_DISPATCH(CellLandings)(flow, j, cells, landing);
}

void cellsHidden(const std::int32_t* landing, const float* nearest, const float* s,
                 const HiddenRule& rule, std::size_t count, CellVector* out) {
    HWY_DYNAMIC_DISPATCH(CellsHidden)(landing, nearest, s, rule, count, out);
}

void alignCells(const FlowEnds& ends, const CellRow& row, const CellVector* flow,
                const CellVector* start, float step, float leastWay, float* s) {
    HWY_DYNAMIC_DISPATCH(AlignCells)(ends, row, flow, start, step, leastWay, s);
}

void predictCells(const CellMotion& motion, const float* raysX, const float* raysY, const float* s,
                  std::size_t count, Size cells, std::int32_t* landing, float* moved) {
    HWY_DYNAMIC_DISPATCH(PredictCells)(motion, raysX, raysY, s, count, cells, landing, moved);
}

}  // namespace mfar::simd
#endif
