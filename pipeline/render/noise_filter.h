#pragma once

#include "base/geometry.h"
#include "pipeline/simd/noise_rows.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mfar {

/// Light of one pixel's surface in two parts that are filtered separately (see KnownLight).
/// Variances are of the luminance; a negative variance is unknown. Counts are numbers of samples.
struct LightPixel {
    Eigen::Array3f first{0, 0, 0}, second{0, 0, 0};
    /// A variance from fewer samples than this counts as unknown.
    static constexpr float kFew = 4;
    float firstVariance = 0, secondVariance = 0;
    float firstCount = 0, secondCount = 0;
    Eigen::Array3f normal{0, 0, 0};  ///< surface normal, unit length
    float depth = 0;                 ///< [m] along the optical axis
    std::uint8_t id = 0;             ///< surface id; 0: several surfaces or none
    /// True: the filter does not change this pixel, but still uses its light for its neighbours.
    bool kept = false;
};

/// Smooths noise with edge-avoiding wavelets (Dammertz et al. 2010). Two pixels are not averaged if
/// they differ by more than their variances explain (Schied et al. 2017).
/// The filter works on light without the surface's paint, so that textures stay sharp. A pixel
/// ignores neighbours across a depth edge or on another surface. Neighbours with another normal
/// have less weight. Pixels without an id stay unchanged. A pixel without samples gets its
/// neighbours' light. The samples of a pixel may include a rare bright one. So the light of an
/// object's pixel is limited to the third brightest of its neighbours, but only if noise can
/// explain the excess. This darkens an evenly lit surface by about a quarter of a pixel's standard
/// error.
/// Variances fall with the number of samples, so that the filter finally changes nothing.
/// The filter runs in stages, one after the other. Several threads may filter rows of the same
/// stage at the same time.
class NoiseFilter {
public:
    static constexpr int kLevels = 4;
    static constexpr int kStages = kLevels + 2;

    /// Reserves memory for pictures of `size`.
    void reserve(Size size);
    /// Begins a picture of `size` with the focal length `focal` [px]. Only the pixels in `where`
    /// are filtered. Memory is reused for the next picture.
    void begin(Size size, const PixelRect& where, double focal);
    /// Input, row-major. The caller must fill the pixels in `where` before the first stage.
    [[nodiscard]] std::span<LightPixel> pixels() { return pixels_; }
    void run(int stage, int firstRow, int lastRow);
    /// Output, row-major; valid after the last stage.
    [[nodiscard]] std::span<const LightPixel> filtered() const { return pixels_; }

private:
    struct Variances {
        float first = 0, second = 0;
    };
    /// Upper limits of a pixel's luminances.
    struct Limits {
        float first = std::numeric_limits<float>::infinity(), second = first;
    };
    [[nodiscard]] Limits limitsAt(int x, int y) const;
    /// Sets the limits of a pixel. Estimates its variances if they are unknown.
    void estimateNoise(int x, int y);
    /// Means of the variances of pixels up to `reach` pixels away on the same surface. Pixels
    /// without samples do not count. `known` becomes the number of pixels that count.
    [[nodiscard]] Variances meanAround(int x, int y, int reach, int& known) const;
    void meanVariance(int x, int y);
    void pack(std::size_t pixel);
    void unpack(std::size_t pixel, int set);
    void filterRow(int level, int y);

    // Numbers of the filter's arrays. Each array holds one value of every pixel. The arrays of
    // light exist twice, in two sets: a level of the filter reads one set and writes the other.
    static constexpr int kFirst = 0, kSecond = 3, kFirstVariance = 6, kSecondVariance = 7,
                         kFirstCount = 8, kSecondCount = 9, kOfSet = 10;
    static constexpr int kNormal = 2 * kOfSet, kDepth = kNormal + 3, kId = kNormal + 4,
                         kFixed = kNormal + 5, kArrays = kNormal + 6;
    /// Address of the value of pixel 0 in the array `number`.
    [[nodiscard]] float* array(int number) {
        return values_.data() + static_cast<std::size_t>(number) * stride_ + simd::kNoiseMargin;
    }
    template <class Float>
    [[nodiscard]] std::array<simd::LightPart<Float>, 2> parts(int set);

    /// Calls `use(index)` for the pixel itself and for each neighbour on the same surface, up to
    /// `reach` steps of `step` pixels away.
    template <class Use>
    void forNeighbours(int x, int y, int reach, int step, Use use) const;

    Size size_;
    PixelRect where_;
    float catcherSlope_ = 0;
    std::vector<LightPixel> pixels_;
    std::vector<Variances> variances_;
    std::vector<Limits> limits_;
    std::vector<float> values_;  ///< the filter's arrays, one after the other; see array()
    std::size_t stride_ = 0;     ///< distance between the beginnings of two arrays in values_
};

}  // namespace mfar
