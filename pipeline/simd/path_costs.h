#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kLabels = 16;  ///< number of labels in a vector

/// The cheapest of a pixel's labels, and by how much the neighbouring labels cost more.
struct Valley {
    static constexpr std::uint8_t kUnknown = 255;  ///< outside the window

    std::int32_t label = 0;
    /// Extra costs of label - 2, label - 1, label + 1 and label + 2; each at most 254, or kUnknown.
    std::array<std::uint8_t, 4> rise{};
};

/// A picture whose pixels have `vectors` vectors of labels each; rows have no gaps. Costs and
/// penalties must be so small that the cost of a path stays below 85.
struct PathVolume {
    const std::uint8_t* guide;  ///< the picture whose edges make jumps cheaper
    const std::int16_t* base;   ///< first label of every pixel
    Size size;
    int vectors;
    std::uint8_t step;          ///< penalty for a difference of one label
    int jumpDifferences;        ///< jump penalties are constant from this guide difference on
    const std::uint8_t* jumps;  ///< penalty of larger label differences; 256 entries, indexed by
                                ///< the guide's difference
    const std::uint8_t* costs;  ///< kLabels * vectors per pixel
    std::uint8_t* sums;         ///< sums of the paths, one for each cost
};

/// Numbers of rows and columns that are processed fastest. Threads should split the work at
/// multiples of them.
inline constexpr int kRowsTogether = 4, kColumnsTogether = 32;

/// Bytes of temporary memory that paths along these columns, or along any number of rows, need; 0
/// for paths that stay in registers.
[[nodiscard]] std::size_t pathScratch(int vectors, int columns);

/// Writes the sums of the paths from the left and from the right for rows [first, last).
void pathsAlongRows(const PathVolume& volume, int first, int last, std::uint8_t* scratch);

/// Adds the paths from above and from below for columns [first, last), and finds the cheapest
/// labels.
void pathsAlongColumns(const PathVolume& volume, int first, int last, std::uint8_t* scratch,
                       Valley* out);

}  // namespace mfar::simd
