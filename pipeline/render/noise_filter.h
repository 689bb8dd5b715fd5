#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// A pixel of a picture that has few samples yet.
struct NoisyPixel {
    Eigen::Array4f value{0, 0, 0, 0};    ///< display values, premultiplied by coverage [0, 1]
    Eigen::Array3f baseColour{0, 0, 0};  ///< of the surface
    float variance = 0;                  ///< of a channel of `value`; negative: not known yet
    float depth = 0;                     ///< [m] along the camera's axis
    std::uint8_t id = 0;                 ///< of the surface; 0: more than one, or none
    bool kept = false;                   ///< is not changed, but counts for its neighbours
};

/// Smooths noise and leaves what is more than noise: edge-avoiding wavelets (Dammertz et al. 2010)
/// whose tolerance for a difference of two pixels is what their own variances explain (Schied et
/// al. 2017, without their moments over time). Neighbours across an edge of depth, of the surface's
/// colour or of another surface do not count, and pixels without an id stay as they are. With the
/// samples' number the variances fall, and the filter does nothing in the end.
///
/// It runs in stages, one after the other; rows of a stage may be filtered by several threads at a
/// time.
class NoiseFilter {
public:
    static constexpr int kStages = 5;

    /// Of a picture of `size`, the pixels in `where`. Keeps its memory from one picture to the
    /// next.
    void begin(Size size, const PixelRect& where);
    /// To be filled in `where` before the first stage; row-major.
    [[nodiscard]] std::span<NoisyPixel> pixels() { return pixels_; }
    void run(int stage, int firstRow, int lastRow);
    /// After the last stage; row-major.
    [[nodiscard]] std::span<const NoisyPixel> filtered() const { return other_; }

private:
    void spreadVariance(int x, int y);
    void meanVariance(int x, int y);
    void filter(int step, std::span<const NoisyPixel> from, std::span<NoisyPixel> to, int x,
                int y) const;

    /// Calls `use(index, dx, dy)` for those of the same surface within `reach` steps.
    template <class Use>
    void forNeighbours(std::span<const NoisyPixel> pixels, int x, int y, int reach, int step,
                       Use use) const;

    Size size_;
    PixelRect where_;
    std::vector<NoisyPixel> pixels_, other_;
    std::vector<float> variances_;
};

}  // namespace mfar
