#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kLabels = 16;

/// The cheapest label of a pixel, and the additional costs of the neighbouring labels.
struct Valley {
    static constexpr std::uint8_t kUnknown = 255;  ///< additional cost of a label outside the
                                                   ///< window

    std::int32_t label = 0;
    /// Additional costs of label - 2, label - 1, label + 1 and label + 2: at most 254, or kUnknown.
    std::array<std::uint8_t, 4> rise{};
};

/// Input of semi-global matching, which aggregates costs along straight paths from four directions.
/// Each pixel has a window of `vectors` vectors of labels; rows have no gaps. Costs and penalties
/// must be so small that path costs stay below 85.
struct PathVolume {
    const std::uint8_t* guide;  ///< picture whose edges make large label differences cheaper
    const std::int16_t* base;   ///< first label of each pixel
    Size size;
    int vectors;
    std::uint8_t step;          ///< penalty for a difference of one label
    int jumpDifferences;        ///< `jumps` is constant from this entry on
    const std::uint8_t* jumps;  ///< penalty for larger label differences; 256 entries, indexed by
                                ///< the difference of `guide` between the pixels
    const std::uint8_t* costs;  ///< matching costs, kLabels * vectors per pixel
    std::uint8_t* sums;         ///< for each entry of `costs`: sum of the four paths' costs
};

/// Numbers of rows and columns that are processed together. Threads should split the work at
/// multiples of these numbers.
inline constexpr int kRowsTogether = 4, kColumnsTogether = 32;

/// Returns the size of `scratch` [bytes] for pathsAlongColumns() with `columns` columns, which also
/// suffices for pathsAlongRows(). It is 0 if path costs stay in registers.
[[nodiscard]] std::size_t pathScratch(int vectors, int columns);

/// Writes to `sums` the path costs from the left plus those from the right, for rows [first, last).
void pathsAlongRows(const PathVolume& volume, int first, int last, std::uint8_t* scratch);

/// Adds the path costs from above and from below for columns [first, last), and finds the cheapest
/// label of each pixel.
void pathsAlongColumns(const PathVolume& volume, int first, int last, std::uint8_t* scratch,
                       Valley* out);

}  // namespace mfar::simd
