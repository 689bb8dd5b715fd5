#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace mfar {

/// How near the real scene is at every video pixel, row-major.
struct InverseDepthField {
    static constexpr float kUnknown = std::numeric_limits<float>::infinity();

    Size size;
    std::vector<float> rho;       ///< 1 / z along the video camera's axis [1/m]; 0: infinitely far
    std::vector<float> variance;  ///< of rho [1/m^2]; kUnknown where rho says nothing
    std::vector<std::uint8_t> filled;  ///< 1: not measured, but what its neighbours agree on

    InverseDepthField() = default;
    explicit InverseDepthField(Size s)
        : size(s), rho(static_cast<std::size_t>(s.width) * s.height),
          variance(rho.size(), kUnknown), filled(rho.size()) {}

    [[nodiscard]] bool isKnown(std::size_t pixel) const { return variance[pixel] < kUnknown; }
    /// Values that a known pixel may have. So far from float's ends that their products and the
    /// sums of a picture's are numbers.
    [[nodiscard]] static bool isSound(float rho, float variance) {
        return rho >= 0 && rho < 1e15F && variance > 1e-30F && variance < 1e30F;
    }
    void forget(std::size_t pixel) {
        rho[pixel] = 0;
        variance[pixel] = kUnknown;
        filled[pixel] = 0;
    }
    /// Columns [x0, x1) of row y.
    void forgetRow(int y, int x0, int x1) {
        const auto row = static_cast<std::size_t>(y) * size.width;
        for (std::size_t i = row + x0; i < row + x1; ++i)
            forget(i);
    }
};

}  // namespace mfar
