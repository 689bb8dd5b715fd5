#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kLabels = 16;  ///< of a vector of labels

/// The cheapest of a pixel's labels, and by how much those beside it are dearer.
struct Valley {
    static constexpr std::uint8_t kUnknown = 255;  ///< outside the window

    std::int32_t label = 0;
    /// Of label - 2, label - 1, label + 1 and label + 2: at most 254, or kUnknown.
    std::array<std::uint8_t, 4> rise{};
};

/// A picture whose pixels have `vectors` vectors of labels each; rows without gaps. Costs and
/// penalties are so small that a path's cost stays below 85.
struct PathVolume {
    const std::uint8_t* guide;  ///< the picture whose edges allow jumps
    const std::int16_t* base;   ///< first label of every pixel
    Size size;
    int vectors;
    std::uint8_t step;          ///< penalty of one label's difference
    int jumpDifferences;        ///< jumps are the same from this difference of the guide on
    const std::uint8_t* jumps;  ///< of more, by the difference of the guide: 256
    const std::uint8_t* costs;  ///< kLabels * vectors a pixel
    std::uint8_t* sums;         ///< as many: of the paths
};

/// Rows and columns that are fastest together: boundaries between threads at multiples of them.
inline constexpr int kRowsTogether = 4, kColumnsTogether = 32;

/// Bytes of scratch that the paths of these columns, or of any rows, need; none for paths that stay
/// in registers.
[[nodiscard]] std::size_t pathScratch(int vectors, int columns);

/// Sums of the paths from the left and from the right, rows [first, last).
void pathsAlongRows(const PathVolume& volume, int first, int last, std::uint8_t* scratch);

/// Adds the paths from above and from below, columns [first, last), and finds the cheapest labels.
void pathsAlongColumns(const PathVolume& volume, int first, int last, std::uint8_t* scratch,
                       Valley* out);

}  // namespace mfar::simd
