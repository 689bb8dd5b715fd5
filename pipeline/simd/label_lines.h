#pragma once

#include "base/image_view.h"
#include "pipeline/simd/lens.h"
#include "pipeline/simd/path_costs.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Where a frame's pixels lie in the still's canvas for given labels. Inverse depth s = perLabel *
/// label, see EpipolarLens.
struct LabelLines {
    Lens lens;
    float tx, ty, tz;        ///< translation of points, in the frame's orientation
    float originX, originY;  ///< camera pixel of the canvas's first pixel
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

/// Costs of a row's pixels with census `own`, for kLabels * vectors labels from `base`, ordered by
/// pixel, then by label: Hamming distance to the census of the still's nearest pixel, half of the
/// bits if the still has none. `slack`: takes the smallest of this cost and those one pixel to
/// either side of the line. A vector of labels is short, so the lens is taken as straight along it.
void labelCosts(const LabelLines& lines, const LabelRow& row, const std::int16_t* base,
                const std::uint32_t* own, const CensusPicture& still, int vectors, bool slack,
                std::uint8_t* out);

/// Labels of a row's valleys with sub-label precision. Costs belong to pixels that lie up to 0.7 px
/// off the points of their labels: the fraction is measured from the pixels' feet on the line.
void labelPlaces(const LabelLines& lines, const LabelRow& row, const Valley* valleys, float* out);

/// Labels of valleys with sub-label precision: the vertex of two straight lines through a label and
/// its neighbours (a parabola would lock to whole labels with such costs).
void labelVertices(const Valley* valleys, std::size_t count, float* out);

}  // namespace mfar::simd
