#include "pipeline/simd/luma_kernels.h"

// Highway compiles what follows once for each instruction set.
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

// Up to 15 elements may be written beyond a row's end.
using Floats = hn::CappedTag<float, 16>;
using Vec = hn::Vec<Floats>;

struct Ray {
    Vec x, y;
};

/// base/geometry.h's lens model.
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

/// Fixed-point iterations, as camera.glsl has them.
HWY_INLINE Ray undistorted(const float* distortion, const Ray& target) {
    const Floats d;
    const auto most = hn::Set(d, 0.5F), least = hn::Set(d, -0.5F);
    Ray ray = target;
    for (int i = 0; i < 12; ++i) {
        const Ray seen = distorted(distortion, ray);
        ray.x = hn::Add(ray.x, hn::Min(hn::Max(hn::Sub(target.x, seen.x), least), most));
        ray.y = hn::Add(ray.y, hn::Min(hn::Max(hn::Sub(target.y, seen.y), least), most));
    }
    return ray;
}

constexpr int kTaps = 4;  // each way
// Shares of a pixel, two of which times a pixel fit 32 bits with room to add.
constexpr int kShareBits = 14;
constexpr float kShare = 1 << kShareBits;

/// The taps of one axis: first pixels, and shares of the pixels after those.
struct Taps {
    int first[kTaps], share[kTaps];
};

HWY_INLINE void placeTaps(float centre, float footprint, int size, Taps& out) {
    for (int i = 0; i < kTaps; ++i) {
        const float off = (static_cast<float>(i) + 0.5F) / kTaps - 0.5F;
        const float at = centre + off * footprint;
        // Far outside and NaN: at the border.
        const float held = at > -1 ? std::min(at, static_cast<float>(size)) : -1.0F;
        const float whole = std::floor(held);
        out.first[i] = static_cast<int>(whole);
        out.share[i] = static_cast<int>((held - whole) * kShare + 0.5F);
    }
}

std::uint8_t footprintMean(const StillPicture& p, const Taps& x, const Taps& y) {
    const auto row = [&](int i) { return p.pixels + std::clamp(i, 0, p.height - 1) * p.pitch; };
    const auto column = [&](int i) { return std::clamp(i, 0, p.width - 1); };
    float sum = 0;
    for (int j = 0; j < kTaps; ++j) {
        const std::uint8_t *upper = row(y.first[j]), *lower = row(y.first[j] + 1);
        float across = 0;
        for (int i = 0; i < kTaps; ++i) {
            const int left = column(x.first[i]), right = column(x.first[i] + 1);
            const auto down = static_cast<float>(y.share[j]) / kShare;
            const float a = static_cast<float>(upper[left]) +
                            static_cast<float>(lower[left] - upper[left]) * down;
            const float b = static_cast<float>(upper[right]) +
                            static_cast<float>(lower[right] - upper[right]) * down;
            across += a + (b - a) * (static_cast<float>(x.share[i]) / kShare);
        }
        sum += across;
    }
    return static_cast<std::uint8_t>(std::clamp(sum / (kTaps * kTaps) + 0.5F, 0.0F, 255.0F));
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
        const auto inFront = hn::Gt(z, set(0.05F));
        const Vec outside = set(-1e6F);
        hn::StoreU(hn::IfThenElse(inFront, hn::MulAdd(set(s[0]), seen.x, set(s[2])), outside), d,
                   stillX + x);
        hn::StoreU(hn::IfThenElse(inFront, hn::MulAdd(set(s[1]), seen.y, set(s[3])), outside), d,
                   stillY + x);
    }
}

void FootprintRow(const StillPicture& still, float footprint, const float* stillX,
                  const float* stillY, int width, std::uint8_t* to) {
    Taps x, y;
    for (int i = 0; i < width; ++i) {
        placeTaps(stillX[i], footprint, still.width, x);
        placeTaps(stillY[i], footprint, still.height, y);
        to[i] = footprintMean(still, x, y);
    }
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

void footprintRow(const StillPicture& still, float footprint, const float* stillX,
                  const float* stillY, int width, std::uint8_t* to) {
    HWY_DYNAMIC_DISPATCH(FootprintRow)(still, footprint, stillX, stillY, width, to);
}

}  // namespace mfar::simd
#endif
