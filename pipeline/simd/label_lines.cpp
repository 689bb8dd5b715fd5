#include "pipeline/simd/label_lines.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/label_lines.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/label_lines-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

static_assert(sizeof(Valley) == 8);

// If the points of two successive labels are at most this squared distance apart [px^2],
// labelPlaces() returns the result of labelVertices() and does not use the still's pixels.
constexpr float kLeastWay = 0.1F;

template <class D>
struct Valleys {
    hn::Vec<D> label;
    hn::Vec<hn::RebindToUnsigned<D>> rises;
};

template <class D>
HWY_INLINE Valleys<D> loadValleys(D d, const Valley* from) {
    const hn::RebindToUnsigned<D> dBits;
    const hn::RebindToSigned<D> dInt;
    hn::Vec<decltype(dBits)> label, rises;
    hn::LoadInterleaved2(dBits, reinterpret_cast<const std::uint32_t*>(from), label, rises);
    return {hn::ConvertTo(d, hn::BitCast(dInt, label)), rises};
}

template <int kIndex, class D>
HWY_INLINE hn::Vec<D> riseOf(D d, const Valleys<D>& valleys) {
    const hn::RebindToUnsigned<D> dBits;
    const hn::RebindToSigned<D> dInt;
    const auto byte = hn::And(hn::ShiftRight<8 * kIndex>(valleys.rises), hn::Set(dBits, 255));
    return hn::ConvertTo(d, hn::BitCast(dInt, byte));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V vertices(D d, const Valleys<D>& valleys) {
    const V left = riseOf<1>(d, valleys), right = riseOf<2>(d, valleys);
    const V rise = hn::Max(left, right);
    const V part = hn::Div(hn::Mul(hn::Set(d, 0.5F), hn::Sub(left, right)), rise);
    const auto isPlain =
        hn::Or(hn::Eq(rise, hn::Zero(d)), hn::Eq(rise, hn::Set(d, Valley::kUnknown)));
    return hn::IfThenElse(isPlain, valleys.label, hn::Add(valleys.label, part));
}

/// Finds the still's pixels that are nearest to the labels' points on the epipolar line. In this
/// class, a label is given by its difference from the cheapest label (Valley::label).
template <class D>
struct NearestPixels {
    using V = hn::Vec<D>;
    struct Pixel {
        V x, y;
        V foot;  ///< the label whose point is nearest to the pixel
    };
    struct Side {
        V foot, rise;
    };

    D d;
    Points<V> best, way;
    V perSquare;

    HWY_INLINE Pixel at(float k) const {
        const V from = hn::Set(d, k), half = hn::Set(d, 0.5F);
        const V x = hn::Floor(hn::Add(hn::MulAdd(from, way.x, best.x), half));
        const V y = hn::Floor(hn::Add(hn::MulAdd(from, way.y, best.y), half));
        const V along = hn::Mul(hn::Sub(x, best.x), way.x);
        return {x, y, hn::Mul(hn::MulAdd(hn::Sub(y, best.y), way.y, along), perSquare)};
    }
    /// `own` is the best label's pixel. Of the next two labels in the direction `side` (-1 or 1),
    /// finds the first one with another pixel. Returns the foot of that pixel (Pixel::foot), and
    /// how much more the label costs than the best label: `near` for the first of the two labels,
    /// `far` for the second, kUnknown if both have the pixel `own`.
    HWY_INLINE Side beside(const Pixel& own, float side, V near, V far) const {
        const Pixel one = at(side), two = at(2 * side);
        const auto isNext = [&](const Pixel& p)
                                HWY_ATTR { return hn::Or(hn::Ne(p.x, own.x), hn::Ne(p.y, own.y)); };
        const auto first = isNext(one), second = isNext(two);
        const V rise = hn::IfThenElse(second, far, hn::Set(d, Valley::kUnknown));
        return {hn::IfThenElse(first, one.foot, two.foot), hn::IfThenElse(first, near, rise)};
    }
};

/// Returns the position of the cost minimum in each Valley, as an offset from the best label
/// [labels]. Labels with the same nearest pixel count as one label. Its position is Pixel::foot,
/// where the epipolar line is nearest to this pixel. The result is the best label's foot if the
/// cost of a neighbour is unknown, or if no neighbour costs more.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V bottoms(D d, const Valleys<D>& valleys, const NearestPixels<D>& pixels) {
    const auto own = pixels.at(0);
    const auto left = pixels.beside(own, -1, riseOf<1>(d, valleys), riseOf<0>(d, valleys));
    const auto right = pixels.beside(own, 1, riseOf<2>(d, valleys), riseOf<3>(d, valleys));
    const V leftSlope = hn::Div(left.rise, hn::Sub(own.foot, left.foot));
    const V rightSlope = hn::Div(right.rise, hn::Sub(right.foot, own.foot));
    const auto isRight = hn::Gt(rightSlope, leftSlope);
    const V steeper = hn::IfThenElse(isRight, rightSlope, leftSlope);
    const V over = hn::Div(hn::IfThenElse(isRight, left.rise, right.rise), steeper);
    const V ahead = hn::Add(hn::Add(left.foot, own.foot), over);
    const V behind = hn::Sub(hn::Add(right.foot, own.foot), over);
    const V bottom = hn::Mul(hn::Set(d, 0.5F), hn::IfThenElse(isRight, ahead, behind));
    const V unknown = hn::Set(d, Valley::kUnknown);
    const auto bothKnown = hn::And(hn::Ne(left.rise, unknown), hn::Ne(right.rise, unknown));
    const auto rises = hn::And(bothKnown, hn::Gt(steeper, hn::Zero(d)));
    return hn::IfThenElse(rises, bottom, own.foot);
}

void LabelPlaces(const LabelLines& lines, const LabelRow& row, const Valley* valleys, float* out) {
    forLanes(hn::ScalableTag<float>(), row.width, [&](auto d, std::size_t x) HWY_ATTR {
        const auto valley = loadValleys(d, valleys + x);
        const auto rayX = hn::LoadU(d, row.raysX + x), rayY = hn::LoadU(d, row.raysY + x);
        const auto one = hn::Set(d, 1);
        const auto here = placed(d, lines, rayX, rayY, valley.label);
        const auto next = placed(d, lines, rayX, rayY, hn::Add(valley.label, one));
        const auto wayX = hn::Sub(next.x, here.x), wayY = hn::Sub(next.y, here.y);
        const auto square = hn::MulAdd(wayX, wayX, hn::Mul(wayY, wayY));
        const NearestPixels<decltype(d)> pixels{d, here, {wayX, wayY}, hn::Div(one, square)};
        const auto label = hn::Add(valley.label, bottoms(d, valley, pixels));
        const auto tells = hn::Gt(square, hn::Set(d, kLeastWay));
        hn::StoreU(hn::IfThenElse(tells, label, vertices(d, valley)), d, out + x);
    });
}

void LabelVertices(const Valley* valleys, std::size_t count, float* out) {
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        hn::StoreU(vertices(d, loadValleys(d, valleys + i)), d, out + i);
    });
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(LabelPlaces);
HWY_EXPORT(LabelVertices);

void labelPlaces(const LabelLines& lines, const LabelRow& row, const Valley* valleys, float* out) {
    HWY_DYNAMIC_DISPATCH(LabelPlaces)(lines, row, valleys, out);
}

void labelVertices(const Valley* valleys, std::size_t count, float* out) {
    HWY_DYNAMIC_DISPATCH(LabelVertices)(valleys, count, out);
}

}  // namespace mfar::simd
#endif
