#include "pipeline/simd/depth_rows.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/depth_rows.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/depth_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

constexpr float kLeastLanding = 0.05F;  // z of a ray (x, y, 1) after the rotation must exceed this
constexpr float kUnknown = std::numeric_limits<float>::infinity();

template <class D, class V = hn::Vec<D>>
HWY_INLINE void storePixels(D /*d*/, const PixelOf<D>& at, hn::Mask<D> valid, int width,
                            std::int32_t* to) {
    const hn::RebindToSigned<D> dInt;
    const auto pixel = hn::Add(hn::Mul(at.row, hn::Set(dInt, width)), at.column);
    const auto landed = hn::RebindMask(dInt, hn::And(valid, at.inside));
    hn::StoreU(hn::IfThenElse(landed, pixel, hn::Set(dInt, -1)), dInt, to);
}

void LandRow(const Lens& lens, Size size, const Motion& motion, const float* raysX,
             const float* raysY, const float* s, std::size_t count, std::int32_t* landing) {
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        const auto set = [d](float v) HWY_ATTR { return hn::Set(d, v); };
        const auto rx = hn::LoadU(d, raysX + i), ry = hn::LoadU(d, raysY + i);
        const auto way = hn::LoadU(d, s + i), tz = set(motion.move[2]);
        const auto x = hn::MulAdd(way, hn::NegMulAdd(rx, tz, set(motion.move[0])), rx);
        const auto y = hn::MulAdd(way, hn::NegMulAdd(ry, tz, set(motion.move[1])), ry);
        const Turn<decltype(d)> turn(d, motion.turn.data());
        const auto one = set(1), z = turn.component(2, x, y, one), least = set(kLeastLanding);
        const auto inverse = hn::Div(one, hn::Max(z, least));
        const auto p = projected(d, lens, hn::Mul(turn.component(0, x, y, one), inverse),
                                 hn::Mul(turn.component(1, x, y, one), inverse));
        const PixelOf<decltype(d)> at(d, p, size);
        storePixels(d, at, hn::Gt(z, least), size.width, landing + i);
    });
}

class LaneBounds {
public:
    static constexpr std::size_t kLanes = hn::MaxLanes(hn::ScalableTag<std::int32_t>());

    HWY_INLINE explicit LaneBounds(Size size)
        : lowX_(hn::Set(D(), size.width)), lowY_(hn::Set(D(), size.height)),
          highX_(hn::Set(D(), -1)), highY_(highX_) {}

    template <class Columns, class Mask>
    HWY_INLINE void add(Columns columns, Columns rows, Mask valid) {
        lowX_ = hn::Min(lowX_, hn::IfThenElse(valid, columns, lowX_));
        lowY_ = hn::Min(lowY_, hn::IfThenElse(valid, rows, lowY_));
        highX_ = hn::Max(highX_, hn::IfThenElse(valid, columns, highX_));
        highY_ = hn::Max(highY_, hn::IfThenElse(valid, rows, highY_));
    }
    [[nodiscard]] HWY_INLINE PixelRect rect() const {
        const auto lane = [](hn::Vec<D> v) HWY_ATTR { return hn::GetLane(v); };
        return {lane(hn::MinOfLanes(D(), lowX_)), lane(hn::MinOfLanes(D(), lowY_)),
                lane(hn::MaxOfLanes(D(), highX_)) + 1, lane(hn::MaxOfLanes(D(), highY_)) + 1};
    }

private:
    using D = hn::ScalableTag<std::int32_t>;
    hn::Vec<D> lowX_, lowY_, highX_, highY_;
};

void MoveRow(const Lens& lens, Size size, const Motion& motion, const MoveRule& rule,
             const DepthPoints& from, std::size_t count, const MovedPoints& to, PixelRect& bounds) {
    LaneBounds lanes(size);
    PixelRect all;
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        const hn::RebindToSigned<decltype(d)> dInt;
        const auto set = [d](float v) HWY_ATTR { return hn::Set(d, v); };
        const auto load = [&](const float* row) HWY_ATTR { return hn::LoadU(d, row + i); };
        const auto one = set(1), inverseDepth = load(from.inverseDepth);
        const auto before = load(from.variance);
        const auto x = hn::MulAdd(set(rule.pixelX), load(from.x), load(from.raysX));
        const auto y = hn::MulAdd(set(rule.pixelY), load(from.y), load(from.raysY));
        const Turn<decltype(d)> turn(d, motion.turn.data());
        const auto turnedZ = turn.component(2, x, y, one);
        const auto z = hn::MulAdd(inverseDepth, set(motion.move[2]), turnedZ);
        const auto inverse = hn::Div(one, z);
        const auto u = hn::MulAdd(inverseDepth, set(motion.move[0]), turn.component(0, x, y, one));
        const auto v = hn::MulAdd(inverseDepth, set(motion.move[1]), turn.component(1, x, y, one));
        const auto p = projected(d, lens, hn::Mul(u, inverse), hn::Mul(v, inverse));
        const PixelOf<decltype(d)> at(d, p, size);
        const auto moved = hn::Mul(inverseDepth, inverse);
        const auto slope = hn::Mul(hn::Mul(turnedZ, inverse), inverse);  // d moved / d inverseDepth
        const auto growth = hn::Mul(set(rule.growth), inverseDepth);
        const auto grown = hn::MulAdd(growth, inverseDepth, before);
        const auto variance = hn::Mul(hn::Mul(grown, slope), slope);
        const auto known = hn::And(hn::Lt(before, set(kUnknown)), hn::Gt(z, set(rule.leastDepth)));
        const auto valid = hn::And(hn::And(known, at.inside), isSound(d, moved, variance));
        storePixels(d, at, valid, size.width, to.pixel + i);
        hn::StoreU(hn::Sub(p.x, hn::ConvertTo(d, at.column)), d, to.x + i);
        hn::StoreU(hn::Sub(p.y, hn::ConvertTo(d, at.row)), d, to.y + i);
        hn::StoreU(moved, d, to.inverseDepth + i);
        hn::StoreU(variance, d, to.variance + i);
        if constexpr (hn::MaxLanes(decltype(d)()) == LaneBounds::kLanes) {
            lanes.add(at.column, at.row, hn::RebindMask(dInt, valid));
        } else if (to.pixel[i] >= 0) {
            const int column = to.pixel[i] % size.width, row = to.pixel[i] / size.width;
            all = around(all, {column, row, column + 1, row + 1});
        }
    });
    for (const PixelRect& part : {lanes.rect(), all})
        if (!part.empty()) bounds = around(bounds, part);
}

void MeasureRow(const SearchedRow& row, const MeasureRule& rule, std::size_t count,
                float* inverseDepth, float* variance) {
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        const hn::RebindToSigned<decltype(d)> dInt;
        const auto set = [d](float v) HWY_ATTR { return hn::Set(d, v); };
        const auto s = hn::LoadU(d, row.s + i), tz = set(rule.t[2]), one = set(1);
        const auto landing = hn::LoadU(dInt, row.landing + i);
        const auto place = hn::Max(landing, hn::Zero(dInt));
        const auto first = hn::GatherIndex(d, row.nearest, place);
        const auto landed = hn::RebindMask(d, hn::Gt(landing, hn::Set(dInt, -1)));
        const auto seen = hn::And(landed, hn::Ge(hn::Add(s, set(rule.slack)), first));
        const auto wayX = hn::NegMulAdd(hn::LoadU(d, row.raysX + i), tz, set(rule.t[0]));
        const auto wayY = hn::NegMulAdd(hn::LoadU(d, row.raysY + i), tz, set(rule.t[1]));
        const auto square = hn::MulAdd(wayX, wayX, hn::Mul(wayY, wayY));
        const auto depth = hn::NegMulAdd(s, tz, one);
        const auto far = hn::And(hn::Gt(square, hn::Zero(d)), hn::Gt(depth, set(rule.leastDepth)));
        const auto known = hn::And(seen, far);
        const auto squareDepth = hn::Mul(depth, depth);
        const auto share = hn::Div(set(rule.error * rule.perUnit), squareDepth);
        const auto v = hn::Div(hn::Mul(share, share), square);
        const auto value = hn::Max(hn::Mul(hn::Div(s, depth), set(rule.perUnit)), hn::Zero(d));
        hn::StoreU(hn::IfThenElseZero(known, value), d, inverseDepth + i);
        hn::StoreU(hn::IfThenElse(known, v, set(kUnknown)), d, variance + i);
    });
}

void TakeCells(const CellField& field, int first, int y, const float* own, float same,
               std::size_t count, float* out) {
    const auto place = [](float pixel, int cells) {
        return std::clamp((pixel - 1.5F) / 4, 0.0F, static_cast<float>(cells) - 1);
    };
    const int width = field.size.width, height = field.size.height;
    const float v = place(static_cast<float>(y), height);
    const int j = std::min(static_cast<int>(v), std::max(height - 2, 0));
    const float* above = field.cells + static_cast<std::ptrdiff_t>(j) * width;
    const float* below = above + (height > 1 ? width : 0);
    const float fy = v - static_cast<float>(j);
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        const hn::RebindToSigned<decltype(d)> dInt;
        const auto x = hn::Iota(d, static_cast<float>(first) + static_cast<float>(i));
        auto u = hn::Mul(hn::Sub(x, hn::Set(d, 1.5F)), hn::Set(d, 0.25F));
        u = hn::Min(hn::Max(u, hn::Zero(d)), hn::Set(d, static_cast<float>(width) - 1));
        const auto cell = hn::Min(hn::ConvertTo(dInt, u), hn::Set(dInt, std::max(width - 2, 0)));
        const auto next = hn::Add(cell, hn::Set(dInt, width > 1 ? 1 : 0));
        const auto fx = hn::Sub(u, hn::ConvertTo(d, cell));
        const auto along = [&](const float* row) HWY_ATTR {
            const auto a = hn::GatherIndex(d, row, cell);
            return hn::MulAdd(fx, hn::Sub(hn::GatherIndex(d, row, next), a), a);
        };
        const auto top = along(above), low = along(below);
        const auto s = hn::MulAdd(hn::Set(d, fy), hn::Sub(low, top), top);
        const auto mine = hn::LoadU(d, own + i);
        const auto isSame = hn::Lt(hn::Abs(hn::Sub(s, mine)), hn::Set(d, same));
        hn::StoreU(hn::IfThenElse(isSame, s, mine), d, out + i);
    });
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(LandRow);
HWY_EXPORT(MoveRow);
HWY_EXPORT(MeasureRow);
HWY_EXPORT(TakeCells);

void landRow(const Lens& lens, Size size, const Motion& motion, const float* raysX,
             const float* raysY, const float* s, std::size_t count, std::int32_t* landing) {
    HWY_DYNAMIC_DISPATCH(LandRow)(lens, size, motion, raysX, raysY, s, count, landing);
}

void moveRow(const Lens& lens, Size size, const Motion& motion, const MoveRule& rule,
             const DepthPoints& from, std::size_t count, const MovedPoints& to, PixelRect& bounds) {
    HWY_DYNAMIC_DISPATCH(MoveRow)(lens, size, motion, rule, from, count, to, bounds);
}

void measureRow(const SearchedRow& row, const MeasureRule& rule, std::size_t count,
                float* inverseDepth, float* variance) {
    HWY_DYNAMIC_DISPATCH(MeasureRow)(row, rule, count, inverseDepth, variance);
}

void takeCells(const CellField& field, int first, int y, const float* own, float same,
               std::size_t count, float* out) {
    HWY_DYNAMIC_DISPATCH(TakeCells)(field, first, y, own, same, count, out);
}

}  // namespace mfar::simd
#endif
