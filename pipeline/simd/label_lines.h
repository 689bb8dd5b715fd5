#pragma once

#include "base/image_view.h"
#include "pipeline/simd/lens.h"
#include "pipeline/simd/path_costs.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Where a frame's pixels lie in the still's canvas under their labels: s = perLabel * label, see
/// EpipolarLens.
struct LabelLines {
    Lens lens;
    float tx, ty, tz;        ///< translation of points, in the frame's orientation
    float originX, originY;  ///< camera pixel of the canvas's first
    float perLabel;
};

/// Pixels of a row of the frame.
struct LabelRow {
    const float *raysX, *raysY;
    std::size_t width;
};

/// A picture's census, rows without gaps.
struct CensusPicture {
    const std::uint32_t* pixels;
    Size size;
};

/// Costs of a row's pixels, whose census is `own`, for kLabels * vectors labels from `base` on, by
/// pixel, then by label: differences from the nearest pixels' census in the still; half of the bits
/// where there is none. `slack`: the least of these costs and of those one pixel to either side of
/// the line. A vector of labels is short, so the lens may be taken as straight along it.
void labelCosts(const LabelLines& lines, const LabelRow& row, const std::int16_t* base,
                const std::uint32_t* own, const CensusPicture& still, int vectors, bool slack,
                std::uint8_t* out);

/// Labels of a row's valleys with their sub-label part. Costs belong to pixels, up to 0.7 px beside
/// the points of their labels: the part counts from where those pixels' feet are on the line.
void labelPlaces(const LabelLines& lines, const LabelRow& row, const Valley* valleys, float* out);

/// Labels of valleys with their sub-label part: the vertex of the two straight lines through a
/// label and its neighbours (a parabola would lock to whole labels on such costs).
void labelVertices(const Valley* valleys, std::size_t count, float* out);

}  // namespace mfar::simd
