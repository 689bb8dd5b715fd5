#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Light of one pixel's surface in two parts that are filtered separately (see KnownLight).
/// Variances are of the luminance; a negative variance is unknown. Counts are numbers of samples.
struct LightPixel {
    Eigen::Array3f first{0, 0, 0}, second{0, 0, 0};
    /// With fewer samples, the variance counts as unknown.
    static constexpr float kFew = 4;
    float firstVariance = 0, secondVariance = 0;
    float firstCount = 0, secondCount = 0;
    Eigen::Array3f normal{0, 0, 0};  ///< surface normal, unit length
    float depth = 0;                 ///< [m] along the optical axis
    std::uint8_t id = 0;             ///< surface id; 0: several surfaces or none
    /// If true, the filter does not change this pixel, but its neighbours use its light.
    bool kept = false;
};

/// Smooths noise with edge-avoiding wavelets (Dammertz et al. 2010). Two pixels are not averaged if
/// they differ by more than their variances explain (Schied et al. 2017).
/// The filter works on light without the surface's paint, so that textures stay sharp. A pixel
/// ignores neighbours across a depth edge or on another surface. Neighbours with another normal
/// have less weight. Pixels without an id stay unchanged. A pixel without samples gets its
/// neighbours' light. Variances fall with the number of samples, so that the filter finally changes
/// nothing.
/// The filter runs in stages, one after the other. Several threads may filter rows of the same
/// stage at the same time.
class NoiseFilter {
public:
    static constexpr int kLevels = 4;
    static constexpr int kStages = kLevels + 2;

    /// Begins a picture of `size`. Only the pixels in `where` are filtered. Memory is reused for
    /// the next picture.
    void begin(Size size, const PixelRect& where);
    /// Input, row-major. The caller must fill the pixels in `where` before the first stage.
    [[nodiscard]] std::span<LightPixel> pixels() { return pixels_; }
    void run(int stage, int firstRow, int lastRow);
    /// Output, row-major; valid after the last stage.
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

    /// Calls `use(index, dx, dy)` for each neighbour on the same surface, up to `reach` steps of
    /// `step` pixels away.
    template <class Use>
    void forNeighbours(std::span<const LightPixel> pixels, int x, int y, int reach, int step,
                       Use use) const;

    Size size_;
    PixelRect where_;
    std::vector<LightPixel> pixels_, other_;
    std::vector<Variances> variances_;
};

}  // namespace mfar
