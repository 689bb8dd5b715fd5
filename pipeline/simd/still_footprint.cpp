#include "pipeline/engine/params/luma.h"
#include "pipeline/simd/luma_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/still_footprint.cpp"
#include <algorithm>
#include <cmath>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// Up to 15 entries may be written beyond a row's end.
constexpr int kMostLanes = 16;
using Floats = hn::CappedTag<float, kMostLanes>;
using Vec = hn::Vec<Floats>;

struct Ray {
    Vec x, y;
};

HWY_INLINE Ray distorted(const float* distortion, const Ray& p) {
    const Floats d;
    const auto k = [&](int i) HWY_ATTR { return hn::Set(d, distortion[i]); };
    const Vec xx = hn::Mul(p.x, p.x), yy = hn::Mul(p.y, p.y), xy = hn::Mul(p.x, p.y);
    const Vec r2 = hn::Add(xx, yy), two = hn::Set(d, 2.0F);
    const Vec radial =
        hn::MulAdd(r2, hn::MulAdd(r2, hn::MulAdd(r2, k(4), k(1)), k(0)), hn::Set(d, 1.0F));
    const Vec across = hn::MulAdd(hn::Mul(two, k(2)), xy, hn::Mul(k(3), hn::MulAdd(two, xx, r2)));
    const Vec down = hn::MulAdd(k(2), hn::MulAdd(two, yy, r2), hn::Mul(hn::Mul(two, k(3)), xy));
    return {hn::MulAdd(p.x, radial, across), hn::MulAdd(p.y, radial, down)};
}

/// Inverts distorted() by fixed-point iterations, as camera.glsl does.
HWY_INLINE Ray undistorted(const float* distortion, const Ray& target) {
    const Floats d;
    const auto most = hn::Set(d, 0.5F), least = hn::Set(d, -0.5F);
    Ray ray = target;
    for (int i = 0; i < params::kUndistortSteps; ++i) {
        const Ray seen = distorted(distortion, ray);
        ray.x = hn::Add(ray.x, hn::Min(hn::Max(hn::Sub(target.x, seen.x), least), most));
        ray.y = hn::Add(ray.y, hn::Min(hn::Max(hn::Sub(target.y, seen.y), least), most));
    }
    return ray;
}

constexpr int kTaps = params::kFootprintTaps;
// Number of bits of a weight. With 14 bits, a weight of 1 fits into a signed 16-bit integer, and a
// footprint's weighted sum into 32 bits.
constexpr int kShareBits = 14;
constexpr float kShare = 1 << kShareBits;

/// Samples along one axis of a footprint, which is the area of a video pixel in the still. Each
/// sample is interpolated between the pixels `first` and `first` + 1; `share` is the weight of the
/// second [1 / kShare].
struct Taps {
    int first[kTaps], share[kTaps];
};

HWY_INLINE void placeTaps(float centre, float footprint, int size, Taps& out) {
    for (int i = 0; i < kTaps; ++i) {
        const float off = (static_cast<float>(i) + 0.5F) / kTaps - 0.5F;
        const float at = centre + off * footprint;
        // Positions far outside, and NaN, are clamped to the border.
        const float held = at > -1 ? std::min(at, static_cast<float>(size)) : -1.0F;
        const float whole = std::floor(held);
        out.first[i] = static_cast<int>(whole);
        const float rounding = 0.5F;
        out.share[i] = static_cast<int>(std::floor((held - whole) * kShare + rounding));
    }
}

std::uint8_t footprintMean(const StillPicture& p, float light, const Taps& x, const Taps& y) {
    const auto row = [&](int i) { return p.pixels + std::clamp(i, 0, p.height - 1) * p.pitch; };
    const auto column = [&](int i) { return std::clamp(i, 0, p.width - 1); };
    float sum = 0, squares = 0;
    for (int j = 0; j < kTaps; ++j) {
        const std::uint8_t *upper = row(y.first[j]), *lower = row(y.first[j] + 1);
        for (int i = 0; i < kTaps; ++i) {
            const int left = column(x.first[i]), right = column(x.first[i] + 1);
            const auto down = static_cast<float>(y.share[j]) / kShare;
            const float a = static_cast<float>(upper[left]) +
                            static_cast<float>(lower[left] - upper[left]) * down;
            const float b = static_cast<float>(upper[right]) +
                            static_cast<float>(lower[right] - upper[right]) * down;
            const float value = a + (b - a) * (static_cast<float>(x.share[i]) / kShare);
            sum += value;
            squares += value * value;
        }
    }
    const float mean = sum / (kTaps * kTaps), root = std::sqrt(squares / (kTaps * kTaps));
    const float seen = mean + light * (root - mean);
    return static_cast<std::uint8_t>(std::clamp(seen + 0.5F, 0.0F, 255.0F));
}

#if HWY_TARGET != HWY_SCALAR
// Number of pixels in a row that are loaded at once. All samples of a footprint must lie in them.
constexpr int kWindow = 16;
constexpr float kMostFootprint = 16;
// Values between two rows are stored in 1/16 grey level.
constexpr int kValueBits = 4;
using Four = hn::FixedTag<float, kTaps>;
using FourInt = hn::FixedTag<std::int32_t, kTaps>;
using Taps16 = hn::FixedTag<std::int16_t, 2 * kTaps>;

struct TapLanes {
    hn::Vec<FourInt> first, share;

    HWY_INLINE TapLanes(hn::Vec<Four> offsets, float centre) {
        const Four d;
        const FourInt dInt;
        const auto at = hn::Add(hn::Set(d, centre), offsets), whole = hn::Floor(at);
        first = hn::ConvertTo(dInt, whole);
        share = hn::ConvertTo(dInt, hn::Mul(hn::Sub(at, whole), hn::Set(d, kShare)));
    }
};

/// Returns for each sample the two pixels of a row between which it lies. `at`: indices of these
/// pixels in `window`.
HWY_INLINE hn::Vec<Taps16> tapsOf(const std::uint8_t* window,
                                  hn::VFromD<hn::FixedTag<std::uint8_t, 2 * kTaps>> at) {
    const hn::FixedTag<std::uint8_t, kWindow> dWindow;
    return hn::PromoteTo(Taps16(), hn::TableLookupBytes(hn::LoadU(dWindow, window), at));
}

/// Returns the samples between the pairs of pixels in `pairs`. `share`: weight of the second pixel.
HWY_INLINE hn::Vec<Four> between(hn::Vec<Taps16> pairs, hn::Vec<Four> share) {
    const Four d;
    const FourInt dInt;
    const auto both = hn::BitCast(dInt, pairs);
    const auto first = hn::ConvertTo(d, hn::And(both, hn::Set(dInt, 0xFFFF)));
    const auto second = hn::ConvertTo(d, hn::ShiftRight<16>(both));
    return hn::MulAdd(hn::Sub(second, first), share, first);
}

/// Sums over the samples of each pixel's footprint. Each sum is stored in four parts.
struct FootprintSums {
    std::int32_t samples[kMostLanes][kTaps] = {};  ///< [1 / (16 * kShare) grey level]
    float squares[kMostLanes][kTaps] = {};         ///< only for means of light [1/256 grey level^2]
};

template <bool kOfLight>
HWY_INLINE void sumWindow(const StillPicture& p, const TapLanes& x, const TapLanes& y, int left,
                          int pixel, FootprintSums& to) {
    const Four d;
    const Taps16 d16;
    const FourInt dInt;
    const hn::FixedTag<std::uint16_t, kTaps> dPairs;
    const hn::FixedTag<std::uint8_t, 2 * kTaps> dBytes;
    const auto index = hn::Sub(x.first, hn::Set(dInt, left));
    const auto next = hn::ShiftLeft<8>(hn::Add(index, hn::Set(dInt, 1)));
    const auto at = hn::BitCast(dBytes, hn::DemoteTo(dPairs, hn::Or(index, next)));
    const auto rest = hn::Sub(hn::Set(dInt, 1 << kShareBits), x.share);
    const auto weights = hn::BitCast(d16, hn::Or(rest, hn::ShiftLeft<16>(x.share)));
    std::int32_t rows[kTaps], shares[kTaps];
    hn::StoreU(y.first, dInt, rows);
    hn::StoreU(y.share, dInt, shares);
    auto sum = hn::Zero(dInt), sum1 = hn::Zero(dInt);
    auto squares = hn::Zero(d);
    const auto across = hn::Mul(hn::ConvertTo(d, x.share), hn::Set(d, 1 / kShare));
    for (int j = 0; j < kTaps; ++j) {
        const std::uint8_t* window = p.pixels + rows[j] * p.pitch + left;
        const auto upper = tapsOf(window, at), lower = tapsOf(window + p.pitch, at);
        const auto step = hn::ShiftLeft<kValueBits + 1>(hn::Sub(lower, upper));
        const auto down = hn::Set(d16, static_cast<std::int16_t>(shares[j]));
        const auto v = hn::Add(hn::ShiftLeft<kValueBits>(upper), hn::MulFixedPoint15(step, down));
        sum = hn::ReorderWidenMulAccumulate(dInt, v, weights, sum, sum1);
        if constexpr (kOfLight) {
            const auto sample = between(v, across);
            squares = hn::MulAdd(sample, sample, squares);
        }
    }
    hn::StoreU(hn::Add(sum, sum1), dInt, to.samples[pixel]);
    if constexpr (kOfLight) hn::StoreU(squares, d, to.squares[pixel]);
}

/// Adds up the four parts of each pixel's sum, for as many pixels as Floats has lanes.
template <class D>
HWY_INLINE hn::Vec<D> sumsOfParts(D d, const hn::TFromD<D> (*parts)[kTaps]) {
    hn::Vec<D> a, b, c, e;
    hn::LoadInterleaved4(d, parts[0], a, b, c, e);
    return hn::Add(hn::Add(a, b), hn::Add(c, e));
}

template <bool kOfLight>
HWY_INLINE void storeMeans(const FootprintSums& sums, float light, int count, std::uint8_t* to) {
    const Floats d;
    const hn::RebindToSigned<Floats> dInt;
    const hn::Rebind<std::uint8_t, Floats> dBytes;
    std::uint8_t means[kMostLanes];
    constexpr float kUnit = 1 << kValueBits, kSamples = kTaps * kTaps;
    const auto unit = hn::Set(d, 1 / (kUnit * kShare * kSamples)), half = hn::Set(d, 0.5F);
    const auto squareUnit = hn::Set(d, 1 / (kUnit * kUnit * kSamples));
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
        const auto sum = hn::ConvertTo(d, sumsOfParts(dInt, sums.samples + i));
        auto rounded = hn::MulAdd(sum, unit, half);
        if constexpr (kOfLight) {
            const auto root = hn::Sqrt(hn::Mul(sumsOfParts(d, sums.squares + i), squareUnit));
            const auto above = hn::Sub(root, hn::Mul(sum, unit));
            rounded = hn::MulAdd(hn::Set(d, light), above, rounded);
        }
        hn::StoreU(hn::DemoteTo(dBytes, hn::ConvertTo(dInt, rounded)), dBytes, means + i);
    }
    std::copy_n(means, count, to);
}
#endif

template <bool kOfLight>
void meanRow(const StillPicture& still, const Footprint& footprint, const float* stillX,
             const float* stillY, int width, std::uint8_t* to) {
    const auto slowly = [&](int i) {
        Taps x, y;
        placeTaps(stillX[i], footprint.width, still.width, x);
        placeTaps(stillY[i], footprint.width, still.height, y);
        to[i] = footprintMean(still, footprint.light, x, y);
    };
#if HWY_TARGET == HWY_SCALAR
    for (int i = 0; i < width; ++i)
        slowly(i);
#else
    const Four d;
    const auto offsets = hn::Mul(hn::Sub(hn::Iota(d, 0.5F), hn::Set(d, kTaps / 2.0F)),
                                 hn::Set(d, footprint.width / kTaps));
    const float reach = footprint.width * (kTaps - 1) / (2 * kTaps);
    // All comparisons are false if q is NaN.
    const auto within = [&](float q, int room, int size) {
        return q - reach >= 0 && q - reach + static_cast<float>(room) <= static_cast<float>(size) &&
               q + reach + 2 <= static_cast<float>(size);
    };
    FootprintSums sums;
    for (int first = 0; first < width; first += kMostLanes) {
        const int count = std::min(kMostLanes, width - first);
        unsigned outside = 0;
        for (int k = 0; k < count; ++k) {
            const float x = stillX[first + k], y = stillY[first + k];
            if (footprint.width <= kMostFootprint && within(x, kWindow, still.width) &&
                within(y, 2, still.height)) {
                const TapLanes across(offsets, x);
                sumWindow<kOfLight>(still, across, TapLanes(offsets, y), hn::GetLane(across.first),
                                    k, sums);
            } else {
                outside |= 1U << k;
            }
        }
        storeMeans<kOfLight>(sums, footprint.light, count, to + first);
        for (int k = 0; outside != 0; ++k, outside >>= 1)
            if ((outside & 1) != 0) slowly(first + k);
    }
#endif
}

}  // namespace

void StillPixelRow(const StillLens& lens, int y, int width, float* stillX, float* stillY) {
    const Floats d;
    const auto set = [&](float v) HWY_ATTR { return hn::Set(d, v); };
    const float *v = lens.videoPinhole, *s = lens.stillPinhole, *r = lens.rotation;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    for (int x = 0; x < width; x += lanes) {
        const Vec column = hn::Iota(d, static_cast<float>(x));
        const Ray target{hn::Mul(hn::Sub(column, set(v[2])), set(1 / v[0])),
                         set((static_cast<float>(y) - v[3]) / v[1])};
        const Ray ray = undistorted(lens.videoDistortion, target);
        const auto turned = [&](int i) HWY_ATTR {
            return hn::MulAdd(set(r[i]), ray.x, hn::MulAdd(set(r[i + 1]), ray.y, set(r[i + 2])));
        };
        const Vec z = turned(6), inverse = hn::Div(set(1), z);
        const Ray seen = distorted(lens.stillDistortion,
                                   {hn::Mul(turned(0), inverse), hn::Mul(turned(3), inverse)});
        const auto inFront = hn::Gt(z, set(params::kLeastTurnedDepth));
        const Vec outside = set(params::kFarOutside);
        hn::StoreU(hn::IfThenElse(inFront, hn::MulAdd(set(s[0]), seen.x, set(s[2])), outside), d,
                   stillX + x);
        hn::StoreU(hn::IfThenElse(inFront, hn::MulAdd(set(s[1]), seen.y, set(s[3])), outside), d,
                   stillY + x);
    }
}

void FootprintRow(const StillPicture& still, const Footprint& footprint, const float* stillX,
                  const float* stillY, int width, std::uint8_t* to) {
    if (footprint.light > 0)
        meanRow<true>(still, footprint, stillX, stillY, width, to);
    else
        meanRow<false>(still, footprint, stillX, stillY, width, to);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(StillPixelRow);
HWY_EXPORT(FootprintRow);

void stillPixelRow(const StillLens& lens, int y, int width, float* stillX, float* stillY) {
    HWY_DYNAMIC_DISPATCH(StillPixelRow)(lens, y, width, stillX, stillY);
}

void footprintRow(const StillPicture& still, const Footprint& footprint, const float* stillX,
                  const float* stillY, int width, std::uint8_t* to) {
    HWY_DYNAMIC_DISPATCH(FootprintRow)(still, footprint, stillX, stillY, width, to);
}

}  // namespace mfar::simd
#endif
