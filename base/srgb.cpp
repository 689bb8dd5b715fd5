#include "base/srgb.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr float kKnee = 0.0031308F;

}  // namespace

float srgbEncoded(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= kKnee ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

float srgbSlope(float linear) {
    if (!(linear > kKnee)) return 12.92F;
    return 1.055F / 2.4F * std::pow(std::min(linear, 1.0F), 1 / 2.4F - 1);
}

float srgbDecoded(float encoded) {
    return encoded <= 12.92F * kKnee ? encoded / 12.92F
                                     : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

const std::array<float, 256>& linearOfSrgbByte() {
    static const std::array<float, 256> kTable = [] {
        std::array<float, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = srgbDecoded(static_cast<float>(i) / 255);
        return table;
    }();
    return kTable;
}

}  // namespace mfar
