#include "pipeline/simd/detail_kernels.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/detail_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/still_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using U = hn::RebindToUnsigned<F>;

HWY_INLINE hn::Vec<F> Between(const std::array<const float*, 2>& rows, float t, int x) {
    const F df;
    const auto a = hn::LoadU(df, rows[0] + x);
    return hn::MulAdd(hn::Set(df, t), hn::Sub(hn::LoadU(df, rows[1] + x), a), a);
}

/// The class LookUp computes the positions at which output pixels read the still, one vector of
/// pixels after another.
class LookUp {
public:
    LookUp(const LookUpRows& rows, Size size, int begin)
        : rows_(rows), stepX_(hn::Set(F(), rows.stepX)), startX_(hn::Set(F(), rows.startX)),
          startY_(hn::Set(F(), rows.startY)), size_(size),
          pixels_(hn::Iota(F(), static_cast<float>(begin))) {}

    HWY_INLINE Positions next(int x) {
        const F df;
        const auto alongX =
            hn::MulAdd(pixels_, stepX_, hn::Add(Between(rows_.x, rows_.t, x), startX_));
        const auto alongY = hn::Add(Between(rows_.y, rows_.t, x), startY_);
        pixels_ = hn::Add(pixels_, hn::Set(df, static_cast<float>(hn::Lanes(df))));
        return PositionsWithin(size_, alongX, alongY);
    }

private:
    const LookUpRows& rows_;
    hn::Vec<F> stepX_, startX_, startY_;
    Size size_;
    hn::Vec<F> pixels_;
};

void WarpRow(const StillPairs& still, const LookUpRows& rows, int begin, int end,
             std::int16_t* to) {
    const F df;
    const hn::Rebind<std::int16_t, F> d16;
    const int lanes = static_cast<int>(hn::Lanes(df));
    const StillBlocks blocks(still);
    const auto scale = hn::Set(df, 32.0F / 256);
    LookUp lookUp(rows, still.size, begin);
    for (int x = begin; x < end; x += lanes) {
        const Positions at = lookUp.next(x);
        const auto mean = MeanOfFour(blocks.at(at.x, at.y), at);
        hn::StoreU(hn::DemoteTo(d16, hn::NearestInt(hn::Mul(mean, scale))), d16, to + x);
    }
}

void GuideRow(const GuideRows& rows, int begin, int end, const float* from, float* to) {
    const F df;
    const int lanes = static_cast<int>(hn::Lanes(df)), reach = params::kGuideReach;
    constexpr int kMiddle = params::kGuideReach;
    for (int x = begin; x < end; x += lanes) {
        auto sum = hn::Zero(df), count = hn::Zero(df);
        for (std::size_t k = 0; k < GuideRows::kRows; ++k)
            for (int i = x - reach; i <= x + reach; ++i) {
                sum = hn::Add(sum, hn::LoadU(df, rows.differences[k] + i));
                count = hn::Add(count, hn::LoadU(df, rows.trusted[k] + i));
            }
        const auto mean = hn::Div(sum, hn::Max(count, hn::Set(df, 1.0F)));
        const auto trusted = hn::LoadU(df, rows.trusted[kMiddle] + x);
        const auto off = hn::Sub(hn::LoadU(df, rows.differences[kMiddle] + x), mean);
        hn::StoreU(hn::NegMulAdd(trusted, off, hn::LoadU(df, from + x)), df, to + x);
    }
}

void DetailRow(const WarpedRow& warped, const LookUpRows& rows, const std::int16_t* learned,
               int begin, int end, std::int16_t* to) {
    const F df;
    const hn::Rebind<std::int16_t, F> d16;
    const int lanes = static_cast<int>(hn::Lanes(df));
    const auto one = hn::Set(df, 1.0F);
    const auto wide = [](hn::Vec<decltype(d16)> v)
                          HWY_ATTR { return hn::ConvertTo(F(), hn::PromoteTo(I(), v)); };
    for (int x = begin; x < end; x += lanes) {
        const auto low = [&](std::size_t i) HWY_ATTR {
            return hn::MulFixedPoint15(hn::LoadU(d16, warped.low[i] + x),
                                       hn::Set(d16, warped.weights[i]));
        };
        const auto shown = hn::Add(hn::Add(low(0), low(1)), hn::Add(low(2), low(3)));
        const auto share = Between(rows.share, rows.t, x);
        auto added = hn::Mul(wide(hn::Sub(hn::LoadU(d16, warped.luma + x), shown)), share);
        if (learned != nullptr) {
            const auto rest = hn::Sub(one, hn::Min(share, one));
            added = hn::MulAdd(wide(hn::LoadU(d16, learned + x)), rest, added);
        }
        hn::StoreU(hn::DemoteTo(d16, hn::NearestInt(added)), d16, to + x);
    }
}

void FadeRow(const std::int16_t* second, const LookUpRows& secondRows, const LookUpRows& rows,
             int begin, int end, std::int16_t* inOut) {
    const F df;
    const hn::Rebind<std::int16_t, F> d16;
    const int lanes = static_cast<int>(hn::Lanes(df));
    const auto zero = hn::Zero(df), one = hn::Set(df, 1.0F);
    const auto from = hn::Set(df, params::kSecondFrom),
               rise = hn::Set(df, 1 / (params::kSecondAlone - params::kSecondFrom));
    const auto at = [&](const std::int16_t* row) HWY_ATTR {
        return hn::ConvertTo(F(), hn::PromoteTo(I(), hn::LoadU(d16, row)));
    };
    for (int x = begin; x < end; x += lanes) {
        const auto more =
            hn::Sub(Between(secondRows.share, secondRows.t, x), Between(rows.share, rows.t, x));
        const auto seen = hn::Min(hn::Max(hn::Mul(hn::Sub(more, from), rise), zero), one);
        const auto first = at(inOut + x);
        const auto faded = hn::MulAdd(hn::Sub(at(second + x), first), seen, first);
        hn::StoreU(hn::DemoteTo(d16, hn::NearestInt(faded)), d16, inOut + x);
    }
}

using I16 = hn::ScalableTag<std::int16_t>;
using U16 = hn::RebindToUnsigned<I16>;

class Channel {
public:
    explicit Channel(const std::array<std::int16_t, 4>& weights) {
        for (std::size_t i = 0; i < 4; ++i)
            weights_[i] = weights[i];
    }

    HWY_INLINE hn::Vec<U16> operator()(const std::array<const std::int16_t*, 4>& rows, int x,
                                       hn::Vec<I16> added) const {
        const I16 d;
        const auto part = [&](std::size_t i) HWY_ATTR {
            return hn::MulFixedPoint15(hn::LoadU(d, rows[i] + x), hn::Set(d, weights_[i]));
        };
        const auto sum = hn::Add(hn::Add(part(0), part(1)), hn::Add(part(2), part(3)));
        const auto grey = hn::ShiftRight<5>(hn::SaturatedAdd(sum, added));
        return hn::BitCast(U16(), hn::Min(hn::Max(grey, hn::Zero(d)), hn::Set(d, 255)));
    }

private:
    std::array<std::int16_t, 4> weights_{};
};

template <bool kAdds>
HWY_INLINE void Compose(const EnlargedRows& rows, const std::array<std::int16_t, 4>& weights,
                        const std::int16_t* added, int begin, int end, std::uint32_t* to) {
    const I16 d;
    const U16 du;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const Channel channel(weights);
    const auto half = hn::Set(d, 16);
    const auto opaque = hn::Set(du, 0xff00);
    HWY_ALIGN std::uint16_t rest[2 * hn::MaxLanes(I16())];
    for (int x = begin; x < end; x += lanes) {
        const auto more = kAdds ? hn::SaturatedAdd(hn::LoadU(d, added + x), half) : half;
        const auto red = channel(rows[0], x, more), green = channel(rows[1], x, more),
                   blue = channel(rows[2], x, more);
        const auto low = hn::Or(red, hn::ShiftLeft<8>(green)), high = hn::Or(blue, opaque);
        if (x + lanes <= end) {
            hn::StoreInterleaved2(low, high, du, reinterpret_cast<std::uint16_t*>(to + x));
        } else {
            hn::StoreInterleaved2(low, high, du, rest);
            std::memcpy(to + x, rest, static_cast<std::size_t>(end - x) * sizeof(*to));
        }
    }
}

void ComposeRow(const EnlargedRows& rows, const std::array<std::int16_t, 4>& weights,
                const std::int16_t* added, int begin, int end, std::uint32_t* to) {
    if (added != nullptr)
        Compose<true>(rows, weights, added, begin, end, to);
    else
        Compose<false>(rows, weights, nullptr, begin, end, to);
}

template <int kChannel>
HWY_INLINE hn::Vec<F> ChannelOf(hn::Vec<U> pixels) {
    const U du;
    const auto byte = hn::And(hn::ShiftRight<8 * kChannel>(pixels), hn::Set(du, 255));
    return hn::ConvertTo(F(), hn::BitCast(I(), byte));
}

struct Four {
    hn::Vec<U> here, right, below, belowRight;
};

template <int kChannel>
HWY_INLINE hn::Vec<U> Mixed(hn::Vec<U> under, const Four& four, const Positions& at,
                            hn::Vec<F> share) {
    const auto between = [](hn::Vec<F> a, hn::Vec<F> b, hn::Vec<F> t)
                             HWY_ATTR { return hn::MulAdd(hn::Sub(b, a), t, a); };
    const auto upper =
        between(ChannelOf<kChannel>(four.here), ChannelOf<kChannel>(four.right), at.fx);
    const auto lower =
        between(ChannelOf<kChannel>(four.below), ChannelOf<kChannel>(four.belowRight), at.fx);
    const auto over = between(upper, lower, at.fy);
    const auto grey = hn::NearestInt(between(ChannelOf<kChannel>(under), over, share));
    const auto clamped = hn::Min(hn::Max(grey, hn::Zero(I())), hn::Set(I(), 255));
    return hn::ShiftLeft<8 * kChannel>(hn::BitCast(U(), clamped));
}

HWY_INLINE hn::Vec<U> Blended(const BlendPicture& picture, const Positions& at, hn::Vec<F> share,
                              hn::Vec<U> under) {
    const I di;
    const auto pitch = hn::Set(di, static_cast<std::int32_t>(picture.pitch));
    const auto last = hn::Set(di, picture.size.height - 1);
    const auto next = hn::Min(hn::Add(at.y, hn::Set(di, 1)), last);
    const auto upper = hn::Add(hn::Mul(at.y, pitch), at.x);
    const auto lower = hn::Add(hn::Mul(next, pitch), at.x);
    const Four four{
        hn::GatherIndex(U(), picture.data, upper), hn::GatherIndex(U(), picture.data + 1, upper),
        hn::GatherIndex(U(), picture.data, lower), hn::GatherIndex(U(), picture.data + 1, lower)};
    return hn::Or(hn::Or(Mixed<0>(under, four, at, share), Mixed<1>(under, four, at, share)),
                  hn::Or(Mixed<2>(under, four, at, share), hn::Set(U(), 0xff000000U)));
}

void BlendRow(const BlendPicture& picture, const LookUpRows& rows, int begin, int end,
              std::uint32_t* inOut) {
    const U du;
    const int lanes = static_cast<int>(hn::Lanes(du));
    LookUp lookUp(rows, picture.size, begin);
    HWY_ALIGN std::uint32_t rest[hn::MaxLanes(U())] = {};
    for (int x = begin; x < end; x += lanes) {
        const Positions at = lookUp.next(x);
        const auto share = Between(rows.share, rows.t, x);
        if (x + lanes <= end) {
            hn::StoreU(Blended(picture, at, share, hn::LoadU(du, inOut + x)), du, inOut + x);
        } else {
            const std::size_t bytes = static_cast<std::size_t>(end - x) * sizeof(*inOut);
            std::memcpy(rest, inOut + x, bytes);
            hn::Store(Blended(picture, at, share, hn::Load(du, rest)), du, rest);
            std::memcpy(inOut + x, rest, bytes);
        }
    }
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(WarpRow);
HWY_EXPORT(GuideRow);
HWY_EXPORT(DetailRow);
HWY_EXPORT(FadeRow);
HWY_EXPORT(ComposeRow);
HWY_EXPORT(BlendRow);

void warpRow(const StillPairs& still, const LookUpRows& lookUp, int begin, int end,
             std::int16_t* to) {
    HWY_DYNAMIC_DISPATCH(WarpRow)(still, lookUp, begin, end, to);
}

void guideRow(const GuideRows& rows, int begin, int end, const float* from, float* to) {
    HWY_DYNAMIC_DISPATCH(GuideRow)(rows, begin, end, from, to);
}

void detailRow(const WarpedRow& warped, const LookUpRows& lookUp, const std::int16_t* learned,
               int begin, int end, std::int16_t* to) {
    HWY_DYNAMIC_DISPATCH(DetailRow)(warped, lookUp, learned, begin, end, to);
}

void fadeRow(const std::int16_t* second, const LookUpRows& secondLookUp, const LookUpRows& lookUp,
             int begin, int end, std::int16_t* inOut) {
    HWY_DYNAMIC_DISPATCH(FadeRow)(second, secondLookUp, lookUp, begin, end, inOut);
}

void composeRow(const EnlargedRows& rows, const std::array<std::int16_t, 4>& weights,
                const std::int16_t* added, int begin, int end, std::uint32_t* to) {
    HWY_DYNAMIC_DISPATCH(ComposeRow)(rows, weights, added, begin, end, to);
}

void blendRow(const BlendPicture& picture, const LookUpRows& lookUp, int begin, int end,
              std::uint32_t* inOut) {
    HWY_DYNAMIC_DISPATCH(BlendRow)(picture, lookUp, begin, end, inOut);
}

}  // namespace mfar::simd
#endif
