#include "pipeline/render/exposure.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr float kSrgbKnee = 0.0031308F;

}  // namespace

float srgbEncoded(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= kSrgbKnee ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

float srgbSlope(float linear) {
    if (!(linear > kSrgbKnee)) return 12.92F;
    return 1.055F / 2.4F * std::pow(std::min(linear, 1.0F), 1 / 2.4F - 1);
}

float srgbDecoded(float encoded) {
    return encoded <= 12.92F * kSrgbKnee ? encoded / 12.92F
                                         : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

Eigen::Vector3f displayed(const Eigen::Vector3f& radiance, const Exposure& exposure) {
    Eigen::Vector3f out;
    for (int c = 0; c < 3; ++c)
        out[c] = srgbEncoded(radiance[c] * exposure.scale);
    return out;
}

}  // namespace mfar
