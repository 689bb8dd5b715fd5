#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kLabels = 16;

/// The cheapest label of a pixel, and how much more its neighbouring labels cost. A label is an
/// inverse depth, counted in steps (see LabelLines).
struct Valley {
    /// Additional cost of a label that is not one of the pixel's labels.
    static constexpr std::uint8_t kUnknown = 255;

    std::int32_t label = 0;
    /// Costs of label - 2, label - 1, label + 1 and label + 2 minus the cost of `label`: at most
    /// 254, or kUnknown.
    std::array<std::uint8_t, 4> rise{};
};

/// Input of semi-global matching (see semi_global.h), which sums the path costs of labels along
/// straight paths from four directions. Each pixel has a window of kLabels * `vectors` successive
/// labels. Rows have no gaps. Costs and penalties must be so small that a path cost stays below 85,
/// because a byte stores the sum of the path costs from three directions. The fourth is not stored;
/// it is added when the cheapest label is determined.
struct PathVolume {
    const std::uint8_t* guide;  ///< picture whose edges make large label differences cheaper
    const std::int16_t* base;   ///< first label of each pixel's window
    Size size;
    int vectors;
    std::uint8_t step;    ///< penalty if two neighbouring pixels' labels differ by one
    int jumpDifferences;  ///< `jumps` is constant from this entry on
    /// Penalty if two neighbouring pixels' labels differ by more than one: 256 entries, indexed by
    /// |difference of `guide` between the two pixels|.
    const std::uint8_t* jumps;
    const std::uint8_t* costs;  ///< matching costs, kLabels * vectors per pixel
    std::uint8_t* sums;         ///< results and temporary values, one for each entry of `costs`
};

/// pathsAlongRows() and pathsAlongColumns() process up to this number of rows or columns together.
/// Threads should split the work at multiples of this number.
inline constexpr int kRowsTogether = 4, kColumnsTogether = 32;

/// Returns the size of `scratch` [bytes] for pathsAlongColumns() with `columns` columns. It also
/// suffices for pathsAlongRows(). It can be 0 if `vectors` is 1.
[[nodiscard]] std::size_t pathScratch(int vectors, int columns);

/// Writes the path costs from the left plus those from the right to `volume.sums`, for rows
/// [first, last).
void pathsAlongRows(const PathVolume& volume, int first, int last, std::uint8_t* scratch);

/// Adds the path costs from above and from below to the results of pathsAlongRows(), for columns
/// [first, last). Writes the cheapest label of each pixel to `out`.
void pathsAlongColumns(const PathVolume& volume, int first, int last, std::uint8_t* scratch,
                       Valley* out);

}  // namespace mfar::simd
