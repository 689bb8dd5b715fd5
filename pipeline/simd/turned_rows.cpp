#include "pipeline/simd/turned_rows.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/turned_rows.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

constexpr float kOutside = -1e6F;
// Only rays (x, y, 1) whose z after the rotation lies between these limits are visible. The upper
// limit is far beyond the z of any lens's ray. Above it, 1 / z would lose precision.
constexpr float kLeastDepth = 0.05F, kMostDepth = 1e30F;

void TurnedPoints(const TurnedLens& lens, const float* raysX, const float* raysY, std::size_t count,
                  float* x, float* y) {
    const auto& r = lens.turn;
    Lens unbounded = lens.lens;
    unbounded.rim2 = hwy::HighestValue<float>();
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t i) HWY_ATTR {
        const auto set = [d](float v) HWY_ATTR { return hn::Set(d, v); };
        const auto rayX = hn::LoadU(d, raysX + i), rayY = hn::LoadU(d, raysY + i);
        const auto row = [&](std::size_t k) HWY_ATTR {
            return hn::MulAdd(set(r[k]), rayX, hn::MulAdd(set(r[k + 1]), rayY, set(r[k + 2])));
        };
        const auto px = row(0), py = row(3), pz = row(6);
        const auto inverse = hn::Div(set(1), pz);
        const auto u = hn::Mul(px, inverse), v = hn::Mul(py, inverse);
        const auto square = hn::MulAdd(u, u, hn::Mul(v, v));
        const auto isShown =
            hn::And(hn::And(hn::Gt(pz, set(kLeastDepth)), hn::Lt(pz, set(kMostDepth))),
                    hn::Lt(square, set(lens.rim * lens.rim)));
        const auto p = projected(d, unbounded, u, v);
        hn::StoreU(hn::IfThenElse(isShown, p.x, set(kOutside)), d, x + i);
        hn::StoreU(hn::IfThenElse(isShown, p.y, set(kOutside)), d, y + i);
    });
}

using DPixels = hn::CappedTag<float, kTurnedCell>;
using VPixels = hn::Vec<DPixels>;

class Sampler {
public:
    explicit Sampler(const Rows<const std::uint8_t>& source)
        : data_(source.data), pitch_(static_cast<std::int32_t>(source.pitch)),
          last_(static_cast<std::int32_t>((source.size.height - 1) * source.pitch) +
                source.size.width - 4) {}

    HWY_INLINE VPixels at(VPixels x, VPixels y) const {
        const auto column = hn::ConvertTo(dInt_, x), row = hn::ConvertTo(dInt_, y);
        const VPixels fx = hn::Sub(x, hn::ConvertTo(d_, column));
        const VPixels fy = hn::Sub(y, hn::ConvertTo(d_, row));
        const auto pitch = hn::Set(dInt_, pitch_);
        const auto first = hn::Add(hn::Mul(row, pitch), column);
        const VPixels top = between(first, fx), low = between(hn::Add(first, pitch), fx);
        return hn::MulAdd(fy, hn::Sub(low, top), top);
    }

private:
    using DInt = hn::RebindToSigned<DPixels>;
    using DBits = hn::RebindToUnsigned<DPixels>;

    /// Interpolates between the pixel at `offset` and the next one. Loads four bytes that contain
    /// both pixels; they begin before `offset` if they would otherwise exceed the picture's end.
    HWY_INLINE VPixels between(hn::Vec<DInt> offset, VPixels share) const {
        const auto from = hn::Min(offset, hn::Set(dInt_, last_));
        const auto words =
            hn::GatherOffset(dInt_, reinterpret_cast<const std::int32_t*>(data_), from);
        const auto skipped = hn::ShiftLeft<3>(hn::Sub(offset, from));
        const auto pair = hn::Shr(hn::BitCast(dBits_, words), hn::BitCast(dBits_, skipped));
        const auto byte = hn::Set(dBits_, 255);
        const VPixels a = grey(hn::And(pair, byte));
        const VPixels b = grey(hn::And(hn::ShiftRight<8>(pair), byte));
        return hn::MulAdd(share, hn::Sub(b, a), a);
    }
    HWY_INLINE VPixels grey(hn::Vec<DBits> v) const {
        return hn::ConvertTo(d_, hn::BitCast(dInt_, v));
    }

    DPixels d_;
    DInt dInt_;
    DBits dBits_;
    const std::uint8_t* data_;
    std::int32_t pitch_, last_;
};

void TurnedRow(const Rows<const std::uint8_t>& source, const TurnedCells& cells, float v,
               std::size_t width, std::uint8_t* out, std::uint8_t* seen) {
    const DPixels d;
    const hn::RebindToSigned<DPixels> dInt;
    const hn::Rebind<std::uint8_t, DPixels> dByte;
    const Sampler sampler(source);
    const auto zero = hn::Zero(d), half = hn::Set(d, 0.5F), low = hn::Set(d, -0.5F);
    const float lastX = static_cast<float>(source.size.width) - 1.001F;
    const float lastY = static_cast<float>(source.size.height) - 1.001F;
    const auto right = hn::Set(d, lastX), bottom = hn::Set(d, lastY);
    const auto endX = hn::Set(d, lastX + 0.5F), endY = hn::Set(d, lastY + 0.5F);
    const auto store = [&](auto word, std::uint8_t* to)
                           HWY_ATTR { hn::StoreU(hn::DemoteTo(dByte, word), dByte, to); };
    const auto draw = [&](std::size_t c, std::uint8_t* greys, std::uint8_t* known) HWY_ATTR {
        const auto at = [&](const float* row, const float* next, std::size_t i)
                            HWY_ATTR { return row[i] + v * (next[i] - row[i]); };
        const float ax = at(cells.x, cells.nextX, c), bx = at(cells.x, cells.nextX, c + 1);
        const float ay = at(cells.y, cells.nextY, c), by = at(cells.y, cells.nextY, c + 1);
        for (int k = 0; k < kTurnedCell; k += static_cast<int>(hn::Lanes(d))) {
            const auto u =
                hn::Mul(hn::Iota(d, static_cast<float>(k)), hn::Set(d, 1.0F / kTurnedCell));
            const auto x = hn::MulAdd(u, hn::Set(d, bx - ax), hn::Set(d, ax));
            const auto y = hn::MulAdd(u, hn::Set(d, by - ay), hn::Set(d, ay));
            const auto isBehind = hn::And(hn::Gt(x, low), hn::Gt(y, low));
            const auto isSeen = hn::And(isBehind, hn::And(hn::Lt(x, endX), hn::Lt(y, endY)));
            const auto grey =
                sampler.at(hn::Min(hn::Max(x, zero), right), hn::Min(hn::Max(y, zero), bottom));
            store(hn::ConvertTo(dInt, hn::Add(grey, half)), greys + k);
            const auto bit = hn::VecFromMask(dInt, hn::RebindMask(dInt, isSeen));
            store(hn::And(bit, hn::Set(dInt, 1)), known + k);
        }
    };
    std::size_t x = 0;
    for (; x + kTurnedCell <= width; x += kTurnedCell)
        draw(x / kTurnedCell, out + x, seen + x);
    if (x == width) return;
    std::uint8_t greys[kTurnedCell], known[kTurnedCell];
    draw(x / kTurnedCell, greys, known);
    std::copy_n(greys, width - x, out + x);
    std::copy_n(known, width - x, seen + x);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(TurnedPoints);
HWY_EXPORT(TurnedRow);

void turnedPoints(const TurnedLens& lens, const float* raysX, const float* raysY, std::size_t count,
                  float* x, float* y) {
    HWY_DYNAMIC_DISPATCH(TurnedPoints)(lens, raysX, raysY, count, x, y);
}

void turnedRow(const Rows<const std::uint8_t>& source, const TurnedCells& cells, float v,
               std::size_t width, std::uint8_t* out, std::uint8_t* seen) {
    HWY_DYNAMIC_DISPATCH(TurnedRow)(source, cells, v, width, out, seen);
}

}  // namespace mfar::simd
#endif
