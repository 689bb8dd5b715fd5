#pragma once

#include "hal/virtual/synthetic_scene.h"

#include <opencv2/core.hpp>

#include <array>
#include <cstdint>

namespace mfar::synthetic {

inline constexpr int kLayerSize = 1024;

/// Generates one texture layer. RGB is the linear reflectance, A the strength of highlights. The
/// layer Clouds and all layers that are passed to Builder::tiled() repeat without a seam.
[[nodiscard]] cv::Mat4b makeLayer(Layer layer, std::uint64_t seed);

/// Calls paint(pixel, {row, column}) for every pixel. OpenCV's forEach() is not used, because race
/// detectors report false races in OpenCV's thread pool.
template <class T, class Paint>
void eachPixel(cv::Mat_<T>& image, const Paint& paint) {
    for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
            const int at[2]{y, x};
            paint(image(y, x), &at[0]);
        }
    }
}

/// Returns smooth noise of about 0..1, interpolated from a grid of `cellsX` by `cellsY` random
/// values. It repeats without a seam.
[[nodiscard]] cv::Mat1f noise(std::uint64_t seed, int cellsX, int cellsY);
/// Returns a weighted sum of several octaves of noise, about 0..1. Each octave is twice as fine as
/// the previous octave and has `gain` times its weight.
[[nodiscard]] cv::Mat1f fractal(std::uint64_t seed, int cellsX, int cellsY, int octaves,
                                float gain = 0.5F);
/// Returns the brightness of a surface that is lit from the upper left. `height` is the height of
/// the surface at each texel. The brightness is 1 where the surface is level. `strength`: change of
/// brightness per difference of height from the texels to the left and above.
[[nodiscard]] cv::Mat1f relief(const cv::Mat1f& height, float strength);
[[nodiscard]] cv::Mat4b toBytes(const cv::Mat3f& colour, const cv::Mat1f& gloss);

inline constexpr int kTagCells = 8;
/// True for the white cells of a tag of family 36h11, as [row][column]. The outermost cells are the
/// black border. tagCells() supports the ids 0 to 35.
using TagCells = std::array<std::array<bool, kTagCells>, kTagCells>;
[[nodiscard]] TagCells tagCells(int id);

[[nodiscard]] cv::Mat4b makePrint(Layer layer, std::uint64_t seed);
[[nodiscard]] cv::Mat4b aprilGrid(std::uint64_t seed);
[[nodiscard]] cv::Mat4b makeNature(Layer layer, std::uint64_t seed);

}  // namespace mfar::synthetic
