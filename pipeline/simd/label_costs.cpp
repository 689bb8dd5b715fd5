#include "pipeline/simd/census_rows.h"
#include "pipeline/simd/label_lines.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/label_costs.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/label_lines-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

constexpr int kSteps = kLabels - 1;
constexpr int kUnseenCost = kCensusBits / 2;
constexpr float kFixed = 65536.0F;
constexpr std::size_t kRun = 64;

using DLabels = hn::CappedTag<std::int32_t, kLabels>;

/// Segments of epipolar lines on the still's canvas [px], one for each of up to kRun pixels. A
/// segment contains the points of kLabels successive labels, so it has kSteps steps.
struct Segments {
    HWY_ALIGN float fromX[kRun], fromY[kRun], wayX[kRun], wayY[kRun];
    /// Start (x, y) and step (dx, dy) of each segment in fixed point [1/kFixed px]. Pixel k covers
    /// the coordinates [k, k + 1). The values are used only if `isInside` is not 0: then both ends
    /// of the segment are in the picture.
    HWY_ALIGN std::int32_t x[kRun], y[kRun], dx[kRun], dy[kRun], isInside[kRun];
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> isInPicture(D d, const Points<V>& p, Size size) {
    const V low = hn::Set(d, -0.49F);
    const auto afterBegin = hn::And(hn::Gt(p.x, low), hn::Gt(p.y, low));
    const V right = hn::Set(d, static_cast<float>(size.width) - 0.51F);
    const V bottom = hn::Set(d, static_cast<float>(size.height) - 0.51F);
    return hn::And(afterBegin, hn::And(hn::Lt(p.x, right), hn::Lt(p.y, bottom)));
}

template <class D>
HWY_INLINE void keepSegments(D d, std::size_t i, const Points<hn::Vec<D>>& from,
                             const Points<hn::Vec<D>>& to, Size size, Segments& out) {
    const hn::RebindToSigned<D> dInt;
    const auto wayX = hn::Sub(to.x, from.x), wayY = hn::Sub(to.y, from.y);
    const auto half = hn::Set(d, 0.5F), fixed = hn::Set(d, kFixed);
    const auto perStep = hn::Set(d, kFixed / kSteps);
    const auto isInside = hn::And(isInPicture(d, from, size), isInPicture(d, to, size));
    const auto whole = [&](auto v) HWY_ATTR { return hn::ConvertTo(dInt, v); };
    hn::StoreU(from.x, d, out.fromX + i);
    hn::StoreU(from.y, d, out.fromY + i);
    hn::StoreU(wayX, d, out.wayX + i);
    hn::StoreU(wayY, d, out.wayY + i);
    hn::StoreU(whole(hn::Mul(hn::Add(from.x, half), fixed)), dInt, out.x + i);
    hn::StoreU(whole(hn::Mul(hn::Add(from.y, half), fixed)), dInt, out.y + i);
    hn::StoreU(whole(hn::Mul(wayX, perStep)), dInt, out.dx + i);
    hn::StoreU(whole(hn::Mul(wayY, perStep)), dInt, out.dy + i);
    hn::StoreU(hn::BitCast(dInt, hn::VecFromMask(d, isInside)), dInt, out.isInside + i);
}

/// Stores in `out` the segments `of`, shifted by one pixel at a right angle to their direction.
/// `side` is 1 or -1 and selects the side. A segment of length 0 is not shifted.
template <class D>
HWY_INLINE void keepBeside(D d, std::size_t i, const Segments& of, float side, Size size,
                           Segments& out) {
    const auto wayX = hn::LoadU(d, of.wayX + i), wayY = hn::LoadU(d, of.wayY + i);
    const auto way = hn::Sqrt(hn::MulAdd(wayX, wayX, hn::Mul(wayY, wayY)));
    const auto isPoint = hn::Not(hn::Gt(way, hn::Zero(d)));
    const auto unit = hn::IfThenZeroElse(isPoint, hn::Div(hn::Set(d, side), way));
    const Points<hn::Vec<D>> from{hn::NegMulAdd(unit, wayY, hn::LoadU(d, of.fromX + i)),
                                  hn::MulAdd(unit, wayX, hn::LoadU(d, of.fromY + i))};
    keepSegments(d, i, from, {hn::Add(from.x, wayX), hn::Add(from.y, wayY)}, size, out);
}

/// Stores the matching costs of a vector of labels of one pixel: the Hamming distances between the
/// pixel's census `own` and the still's census `seen`. The cost is kUnseenCost where `seen` is
/// negative.
template <class V>
HWY_INLINE void storeDifferences(DLabels d, V own, V seen, std::uint8_t* out) {
    const hn::RebindToUnsigned<DLabels> dBits;
    const hn::Rebind<std::uint8_t, DLabels> dCost;
    const auto count = hn::BitCast(d, hn::PopulationCount(hn::BitCast(dBits, hn::Xor(own, seen))));
    const auto cost = hn::IfNegativeThenElse(seen, hn::Set(d, kUnseenCost), count);
    hn::StoreU(hn::DemoteTo(dCost, cost), dCost, out);
}

HWY_INLINE void costsInside(const Segments& segments, std::size_t i, std::uint32_t own,
                            const CensusPicture& still, std::uint8_t* out) {
    const DLabels d;
    const auto* census = reinterpret_cast<const std::int32_t*>(still.pixels);
    const auto x = hn::Set(d, segments.x[i]), y = hn::Set(d, segments.y[i]);
    const auto dx = hn::Set(d, segments.dx[i]), dy = hn::Set(d, segments.dy[i]);
    const auto width = hn::Set(d, still.size.width);
    const auto bits = hn::Set(d, static_cast<std::int32_t>(own));
    for (int k = 0; k < kLabels; k += static_cast<int>(hn::Lanes(d))) {
        const auto label = hn::Iota(d, k);
        const auto column = hn::ShiftRight<16>(hn::Add(x, hn::Mul(label, dx)));
        const auto row = hn::ShiftRight<16>(hn::Add(y, hn::Mul(label, dy)));
        const auto at = hn::Add(hn::Mul(row, width), column);
        storeDifferences(d, bits, hn::GatherIndex(d, census, at), out + k);
    }
}

HWY_INLINE void costsAcrossBorder(const Segments& segments, std::size_t i, std::uint32_t own,
                                  const CensusPicture& still, std::uint8_t* out) {
    const DLabels d;
    const hn::RebindToFloat<DLabels> df;
    const auto* census = reinterpret_cast<const std::int32_t*>(still.pixels);
    const auto bits = hn::Set(d, static_cast<std::int32_t>(own));
    const auto width = hn::Set(d, still.size.width);
    const auto half = hn::Set(df, 0.5F);
    const auto fromX = hn::Set(df, segments.fromX[i]), fromY = hn::Set(df, segments.fromY[i]);
    const auto wayX = hn::Set(df, segments.wayX[i]), wayY = hn::Set(df, segments.wayY[i]);
    for (int k = 0; k < kLabels; k += static_cast<int>(hn::Lanes(d))) {
        const auto a = hn::Div(hn::Iota(df, static_cast<float>(k)), hn::Set(df, kSteps));
        const Points<hn::Vec<decltype(df)>> p{hn::MulAdd(a, wayX, fromX),
                                              hn::MulAdd(a, wayY, fromY)};
        const auto isInside = isInPicture(df, p, still.size);
        const auto pixelOf = [&](auto v) HWY_ATTR {
            return hn::ConvertTo(d, hn::IfThenElseZero(isInside, hn::Add(v, half)));
        };
        const auto at = hn::Add(hn::Mul(pixelOf(p.y), width), pixelOf(p.x));
        const auto seen = hn::IfThenElse(hn::RebindMask(d, isInside),
                                         hn::GatherIndex(d, census, at), hn::Set(d, -1));
        storeDifferences(d, bits, seen, out + k);
    }
}

HWY_INLINE void costsOf(const Segments& segments, std::size_t i, std::uint32_t own,
                        const CensusPicture& still, std::uint8_t* out) {
    if (segments.isInside[i] != 0)
        costsInside(segments, i, own, still, out);
    else
        costsAcrossBorder(segments, i, own, still, out);
}

HWY_INLINE void takeLesser(const Segments& segments, std::size_t i, std::uint32_t own,
                           const CensusPicture& still, std::uint8_t* out) {
    const hn::CappedTag<std::uint8_t, kLabels> d;
    HWY_ALIGN std::uint8_t costs[kLabels];
    costsOf(segments, i, own, still, costs);
    for (int k = 0; k < kLabels; k += static_cast<int>(hn::Lanes(d)))
        hn::StoreU(hn::Min(hn::LoadU(d, out + k), hn::LoadU(d, costs + k)), d, out + k);
}

void LabelCosts(const LabelLines& lines, const LabelRow& row, const std::int16_t* base,
                const std::uint32_t* own, const CensusPicture& still, int vectors, bool slack,
                std::uint8_t* out) {
    const hn::CappedTag<float, kRun> all;
    Segments segments, beside;
    for (std::size_t begin = 0; begin < row.width; begin += kRun) {
        const std::size_t count = std::min(kRun, row.width - begin);
        for (int v = 0; v < vectors; ++v) {
            forLanes(all, count, [&](auto d, std::size_t i) HWY_ATTR {
                const hn::Rebind<std::int16_t, decltype(d)> dBase;
                const hn::RebindToSigned<decltype(d)> dInt;
                const std::size_t x = begin + i;
                const auto label =
                    hn::ConvertTo(d, hn::PromoteTo(dInt, hn::LoadU(dBase, base + x)));
                const auto low = hn::Add(label, hn::Set(d, static_cast<float>(kLabels * v)));
                const auto high = hn::Add(low, hn::Set(d, kSteps));
                const auto rayX = hn::LoadU(d, row.raysX + x), rayY = hn::LoadU(d, row.raysY + x);
                keepSegments(d, i, placed(d, lines, rayX, rayY, low),
                             placed(d, lines, rayX, rayY, high), still.size, segments);
            });
            std::uint8_t* to = out + (begin * vectors + v) * kLabels;
            const std::size_t apart = static_cast<std::size_t>(kLabels) * vectors;
            for (std::size_t i = 0; i < count; ++i)
                costsOf(segments, i, own[begin + i], still, to + i * apart);
            if (!slack) continue;
            for (const float side : {-1.0F, 1.0F}) {
                forLanes(all, count, [&](auto d, std::size_t i) HWY_ATTR {
                    keepBeside(d, i, segments, side, still.size, beside);
                });
                for (std::size_t i = 0; i < count; ++i)
                    takeLesser(beside, i, own[begin + i], still, to + i * apart);
            }
        }
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(LabelCosts);

void labelCosts(const LabelLines& lines, const LabelRow& row, const std::int16_t* base,
                const std::uint32_t* own, const CensusPicture& still, int vectors, bool slack,
                std::uint8_t* out) {
    HWY_DYNAMIC_DISPATCH(LabelCosts)(lines, row, base, own, still, vectors, slack, out);
}

}  // namespace mfar::simd
#endif
