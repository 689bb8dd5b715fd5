#pragma once

#include "hal/virtual/synthetic_scene.h"

#include <opencv2/core.hpp>

#include <array>
#include <cstdint>

namespace mfar::synthetic {

/// Edge of every texture layer [texels].
inline constexpr int kLayerSize = 1024;

/// Generates one layer, kLayerSize squared: linear reflectance in RGB, highlight mask in A. All but
/// Paper, Article, Cover, Label, Forest and Tags tile without a seam.
[[nodiscard]] cv::Mat4b makeLayer(Layer layer, std::uint64_t seed);

/// Calls paint(pixel, {row, column}) for every pixel. Not OpenCV's forEach: its thread pool is
/// invisible to race detectors.
template <class T, class Paint>
void eachPixel(cv::Mat_<T>& image, const Paint& paint) {
    for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
            const int at[2]{y, x};
            paint(image(y, x), &at[0]);
        }
    }
}

// Functions shared by the files that paint layers.

/// Smooth noise of about 0..1 from `cellsX` by `cellsY` random values; tiles without a seam.
[[nodiscard]] cv::Mat1f noise(std::uint64_t seed, int cellsX, int cellsY);
/// Sum of octaves of noise, each twice as fine and `gain` as strong; about 0..1.
[[nodiscard]] cv::Mat1f fractal(std::uint64_t seed, int cellsX, int cellsY, int octaves,
                                float gain = 0.5F);
/// Brightness of a height field lit from the upper left; 1 where it is level.
[[nodiscard]] cv::Mat1f relief(const cv::Mat1f& height, float strength);
/// Converts reflectance and mask to bytes.
[[nodiscard]] cv::Mat4b toBytes(const cv::Mat3f& colour, const cv::Mat1f& gloss);

inline constexpr int kTagCells = 8;  ///< along a side of a tag's black square
/// White cells of a tag of family 36h11, [row][column]; the outermost ones are its black border.
/// Ids 0 to 35.
using TagCells = std::array<std::array<bool, kTagCells>, kTagCells>;
[[nodiscard]] TagCells tagCells(int id);

/// Printed layers (synthetic_print.cpp), the calibration grid (synthetic_grid.cpp) and natural
/// layers (synthetic_nature.cpp).
[[nodiscard]] cv::Mat4b makePrint(Layer layer, std::uint64_t seed);
[[nodiscard]] cv::Mat4b aprilGrid(std::uint64_t seed);
[[nodiscard]] cv::Mat4b makeNature(Layer layer, std::uint64_t seed);

}  // namespace mfar::synthetic
