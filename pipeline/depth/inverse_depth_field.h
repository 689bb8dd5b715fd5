#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace mfar {

/// Inverse depth of the real scene at every video pixel, row-major.
struct InverseDepthField {
    static constexpr float kUnknown = std::numeric_limits<float>::infinity();

    Size size;
    /// 1 / z along the video camera's axis [1/m]. 0 is infinitely far.
    std::vector<float> inverseDepth;
    std::vector<float> variance;  ///< variance of the inverse depth [1/m^2], or kUnknown
    /// 1 if the depth comes from nearby pixels, 0 if it was measured or is unknown.
    std::vector<std::uint8_t> filled;

    InverseDepthField() = default;
    explicit InverseDepthField(Size s)
        : size(s), inverseDepth(static_cast<std::size_t>(s.width) * s.height),
          variance(inverseDepth.size(), kUnknown), filled(inverseDepth.size()) {}

    [[nodiscard]] bool isKnown(std::size_t pixel) const { return variance[pixel] < kUnknown; }
    /// True if these values are valid for a pixel with known depth. The limits keep products of two
    /// inverse depths, and sums of variances over a picture, finite in single precision.
    [[nodiscard]] static bool isSound(float inverseDepth, float variance) {
        return inverseDepth >= 0 && inverseDepth < 1e15F && variance > 1e-30F && variance < 1e30F;
    }
    void forget(std::size_t pixel) {
        inverseDepth[pixel] = 0;
        variance[pixel] = kUnknown;
        filled[pixel] = 0;
    }
    void forgetRow(int y, int x0, int x1) {
        const auto row = static_cast<std::size_t>(y) * size.width;
        for (std::size_t i = row + x0; i < row + x1; ++i)
            forget(i);
    }
};

}  // namespace mfar
