#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Light of one pixel's surface, in two parts that are filtered apart (see KnownLight), each with
/// the variance of its luminance and the number of samples that know it; a negative variance is
/// not known yet.
struct LightPixel {
    Eigen::Array3f first{0, 0, 0}, second{0, 0, 0};
    float firstVariance = 0, secondVariance = 0;
    float firstCount = 0, secondCount = 0;
    Eigen::Array3f normal{0, 0, 0};  ///< of the surface, unit length
    float depth = 0;                 ///< [m] along the camera's axis
    std::uint8_t id = 0;             ///< of the surface; 0: more than one, or none
    bool kept = false;               ///< is not changed, but counts for its neighbours
};

/// Smooths noise and leaves what is more than noise: edge-avoiding wavelets (Dammertz et al. 2010)
/// whose tolerance for a difference of two pixels is what their own variances explain (Schied et
/// al. 2017). It works on light without the surface's paint, so that textures are left alone.
/// Neighbours across an edge of depth, across a bend, or of another surface do not count, and
/// pixels without an id stay as they are. Light that no sample knows is that of the neighbours.
/// With the samples' number the variances fall, and the filter does nothing in the end.
///
/// It runs in stages, one after the other; rows of a stage may be filtered by several threads at a
/// time.
class NoiseFilter {
public:
    static constexpr int kLevels = 4;
    static constexpr int kStages = kLevels + 2;

    /// Of a picture of `size`, the pixels in `where`. Keeps its memory from one picture to the
    /// next.
    void begin(Size size, const PixelRect& where);
    /// To be filled in `where` before the first stage; row-major.
    [[nodiscard]] std::span<LightPixel> pixels() { return pixels_; }
    void run(int stage, int firstRow, int lastRow);
    /// After the last stage; row-major.
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

    /// Calls `use(index, dx, dy)` for those of the same surface within `reach` steps.
    template <class Use>
    void forNeighbours(std::span<const LightPixel> pixels, int x, int y, int reach, int step,
                       Use use) const;

    Size size_;
    PixelRect where_;
    std::vector<LightPixel> pixels_, other_;
    std::vector<Variances> variances_;
};

}  // namespace mfar
