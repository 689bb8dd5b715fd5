#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kLabels = 16;  ///< number of labels in a vector

/// The cheapest of a pixel's labels, and how much more the neighbouring labels cost.
struct Valley {
    static constexpr std::uint8_t kUnknown = 255;  ///< outside the window

    std::int32_t label = 0;
    /// For label - 2, label - 1, label + 1 and label + 2: at most 254, or kUnknown.
    std::array<std::uint8_t, 4> rise{};
};

/// A picture whose pixels have `vectors` vectors of labels each; rows without gaps. Costs and
/// penalties must be so small that a path's cost stays below 85.
struct PathVolume {
    const std::uint8_t* guide;  ///< the picture whose edges make jumps cheaper
    const std::int16_t* base;   ///< first label of every pixel
    Size size;
    int vectors;
    std::uint8_t step;          ///< penalty for a difference of one label
    int jumpDifferences;        ///< from this difference of the guide the jump penalty is constant
    const std::uint8_t* jumps;  ///< penalty of larger differences, by the difference of the guide:
                                ///< 256 entries
    const std::uint8_t* costs;  ///< kLabels * vectors per pixel
    std::uint8_t* sums;         ///< sums of the paths, as many as costs
};

/// Fastest numbers of rows and columns: threads should split the work at multiples of them.
inline constexpr int kRowsTogether = 4, kColumnsTogether = 32;

/// Bytes of scratch for the paths of these columns, or of any number of rows; 0 for paths that stay
/// in registers.
[[nodiscard]] std::size_t pathScratch(int vectors, int columns);

/// Sums of the paths from the left and from the right, rows [first, last).
void pathsAlongRows(const PathVolume& volume, int first, int last, std::uint8_t* scratch);

/// Adds the paths from above and from below, columns [first, last), and finds the cheapest labels.
void pathsAlongColumns(const PathVolume& volume, int first, int last, std::uint8_t* scratch,
                       Valley* out);

}  // namespace mfar::simd
