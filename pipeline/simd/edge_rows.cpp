#include "pipeline/simd/edge_rows.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/edge_rows.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/depth_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

constexpr float kLargest = hwy::HighestValue<float>();

void OpenRow(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
             const float* inverseDepth, const float* variance, std::size_t width,
             const EdgeRule& rule, std::uint8_t* out) {
    forLanes(hn::ScalableTag<float>(), width, [&](auto d, std::size_t x) HWY_ATTR {
        const hn::RebindToSigned<decltype(d)> dInt;
        const hn::Rebind<std::uint8_t, decltype(d)> dByte;
        const auto range = rangeOver(d, low + x, high + x, pitch, rows);
        const auto v = hn::LoadU(d, variance + x);
        const auto known = isSound(d, hn::LoadU(d, inverseDepth + x), v);
        const auto noise = hn::Mul(hn::Set(d, rule.sigmas), hn::Sqrt(hn::IfThenElseZero(known, v)));
        const auto least = hn::MulAdd(hn::Set(d, rule.jump), range.high, noise);
        const auto edge = hn::Gt(hn::Sub(range.high, range.low), least);
        const auto open = hn::RebindMask(dInt, hn::Or(edge, hn::Not(known)));
        const auto one = hn::IfThenElseZero(open, hn::Set(dInt, 1));
        hn::StoreU(hn::DemoteTo(dByte, one), dByte, out + x);
    });
}

using DVoters = hn::CappedTag<float, 16>;
using VVoters = hn::Vec<DVoters>;

template <class Body>
HWY_INLINE void forVoters(const Voters& voters, const PixelRect& window, const Body& body) {
    const DVoters d;
    for (int j = window.y0; j < window.y1; ++j) {
        for (int i = window.x0; i < window.x1; i += static_cast<int>(hn::Lanes(d))) {
            const VVoters inverseDepth = hn::LoadU(d, voters.inverseDepth[j] + i);
            const auto inside = hn::FirstN(d, static_cast<std::size_t>(window.x1 - i));
            body(hn::And(inside, hn::Ge(inverseDepth, hn::Zero(d))), inverseDepth, j, i);
        }
    }
}

struct Side {
    VVoters weight, inverseDepth, variance;

    HWY_INLINE void add(hn::Mask<DVoters> mask, VVoters w, VVoters r, VVoters v) {
        const VVoters own = hn::IfThenElseZero(mask, w);
        weight = hn::Add(weight, own);
        inverseDepth = hn::MulAdd(own, hn::IfThenElseZero(mask, r), inverseDepth);
        variance = hn::MulAdd(own, hn::IfThenElseZero(mask, v), variance);
    }
};

HWY_INLINE float total(VVoters v) {
    return hn::GetLane(hn::SumOfLanes(DVoters(), v));
}

HWY_INLINE void vote(const Voters& voters, const VoteRule& rule, const PixelRect& window,
                     OpenPixel& pixel) {
    const DVoters d;
    pixel.decided = false;
    VVoters lows = hn::Set(d, kLargest), highs = hn::Set(d, -kLargest);
    forVoters(voters, window, [&](auto votes, VVoters inverseDepth, int, int) HWY_ATTR {
        lows = hn::Min(lows, hn::IfThenElse(votes, inverseDepth, lows));
        highs = hn::Max(highs, hn::IfThenElse(votes, inverseDepth, highs));
    });
    const float low = hn::GetLane(hn::MinOfLanes(d, lows));
    const float high = hn::GetLane(hn::MaxOfLanes(d, highs));
    if (low > high) return;
    const VVoters middle = hn::Set(d, 0.5F * (low + high)), one = hn::Set(d, 1);
    const VVoters red = hn::Set(d, pixel.red), green = hn::Set(d, pixel.green);
    const VVoters blue = hn::Set(d, pixel.blue);
    const VVoters scale = hn::Set(d, 1 / (rule.likeness * rule.likeness));
    Side near{hn::Zero(d), hn::Zero(d), hn::Zero(d)}, far = near;
    forVoters(voters, window, [&](auto votes, VVoters inverseDepth, int j, int i) HWY_ATTR {
        const auto apart = [&](const Rows<const float>& channel, VVoters own)
                               HWY_ATTR { return hn::Sub(hn::LoadU(d, channel[j] + i), own); };
        const VVoters r = apart(voters.red, red), g = apart(voters.green, green);
        const VVoters b = apart(voters.blue, blue);
        VVoters square = hn::MulAdd(r, r, hn::MulAdd(g, g, hn::Mul(b, b)));
        square = hn::Mul(square, scale);
        const VVoters weight = hn::Div(one, hn::MulAdd(square, square, one));
        const VVoters variance = hn::LoadU(d, voters.variance[j] + i);
        const auto isNear = hn::Gt(inverseDepth, middle);
        near.add(hn::And(votes, isNear), weight, inverseDepth, variance);
        far.add(hn::And(votes, hn::Not(isNear)), weight, inverseDepth, variance);
    });
    const float nearWeight = total(near.weight), farWeight = total(far.weight);
    const bool isNear = nearWeight > farWeight;
    const float weight = isNear ? nearWeight : farWeight;
    if (!(weight >= rule.leastWeight)) return;
    pixel.inverseDepth = total(isNear ? near.inverseDepth : far.inverseDepth) / weight;
    pixel.variance = total(isNear ? near.variance : far.variance) / weight;
    pixel.decided = true;
}

void VotePixels(const Voters& voters, const VoteRule& rule, const PixelRect& where, int y,
                std::span<OpenPixel> pixels) {
    const auto first = [](int from) { return (from + kVoterStep - 1) / kVoterStep; };
    for (OpenPixel& pixel : pixels) {
        const int x = pixel.x;
        // Range of the voters that are at most rule.radius pixels away, in indices of Voters.
        const PixelRect window{first(std::max(x - rule.radius, where.x0)),
                               first(std::max(y - rule.radius, where.y0)),
                               first(std::min(x + rule.radius + 1, where.x1)),
                               first(std::min(y + rule.radius + 1, where.y1))};
        vote(voters, rule, window, pixel);
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(OpenRow);
HWY_EXPORT(VotePixels);

void openRow(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
             const float* inverseDepth, const float* variance, std::size_t width,
             const EdgeRule& rule, std::uint8_t* out) {
    HWY_DYNAMIC_DISPATCH(OpenRow)(low, high, pitch, rows, inverseDepth, variance, width, rule, out);
}

void votePixels(const Voters& voters, const VoteRule& rule, const PixelRect& where, int y,
                std::span<OpenPixel> pixels) {
    HWY_DYNAMIC_DISPATCH(VotePixels)(voters, rule, where, y, pixels);
}

}  // namespace mfar::simd
#endif
