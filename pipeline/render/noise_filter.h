#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Light of one pixel's surface in two parts that are filtered separately (see KnownLight), each
/// with the variance of its luminance and its number of samples. A negative variance is unknown.
struct LightPixel {
    Eigen::Array3f first{0, 0, 0}, second{0, 0, 0};
    float firstVariance = 0, secondVariance = 0;
    float firstCount = 0, secondCount = 0;
    Eigen::Array3f normal{0, 0, 0};  ///< of the surface, unit length
    float depth = 0;                 ///< [m] along the camera's axis
    std::uint8_t id = 0;             ///< of the surface; 0: several surfaces, or no surface
    bool kept = false;               ///< stays unchanged, but its neighbours use it
};

/// Smooths noise and keeps differences that are larger than noise: edge-avoiding wavelets (Dammertz
/// et al. 2010) that tolerate differences of two pixels as far as their variances explain them
/// (Schied et al. 2017). It filters light without the surface's paint, so that textures stay sharp.
/// Neighbours across a depth edge, across a bend, or on another surface are ignored, and pixels
/// without an id stay unchanged. A pixel without samples gets its neighbours' light. The variances
/// fall with the number of samples, so that in the end the filter changes nothing.
///
/// It runs in stages, one after the other; several threads may filter rows of one stage at a time.
class NoiseFilter {
public:
    static constexpr int kLevels = 4;
    static constexpr int kStages = kLevels + 2;

    /// Begins a picture of `size`, of which the pixels in `where` are filtered. Keeps its memory
    /// from one picture to the next.
    void begin(Size size, const PixelRect& where);
    /// Input: to be filled in `where` before the first stage; row-major.
    [[nodiscard]] std::span<LightPixel> pixels() { return pixels_; }
    void run(int stage, int firstRow, int lastRow);
    /// Output: valid after the last stage; row-major.
    [[nodiscard]] std::span<const LightPixel> filtered() const {
        return kLevels % 2 == 0 ? pixels_ : other_;
    }

private:
    struct Variances {
        float first = 0, second = 0;
    };
    void spreadVariance(int x, int y);
    void meanVariance(int x, int y);
    void filter(int step, std::span<const LightPixel> from, std::span<LightPixel> to, int x,
                int y) const;

    /// Calls `use(index, dx, dy)` for the neighbours of the same surface within `reach` steps.
    template <class Use>
    void forNeighbours(std::span<const LightPixel> pixels, int x, int y, int reach, int step,
                       Use use) const;

    Size size_;
    PixelRect where_;
    std::vector<LightPixel> pixels_, other_;
    std::vector<Variances> variances_;
};

}  // namespace mfar
