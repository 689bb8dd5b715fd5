#pragma once

#include "base/image_view.h"
#include "pipeline/simd/lens.h"
#include "pipeline/simd/path_costs.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Parameters that map labels to points of epipolar lines. A label is a number that stands for the
/// inverse depth s = perLabel * label, see EpipolarLens. The lines are on the still's canvas: the
/// still, drawn with the lens and the orientation of the frame's camera (TurnedPicture).
struct LabelLines {
    Lens lens;
    float tx, ty, tz;        ///< translation of points, in the axes of the frame's camera
    float originX, originY;  ///< position of the canvas's pixel (0, 0) in the picture of `lens`
    float perLabel;
};

struct LabelRow {
    const float *raysX, *raysY;
    std::size_t width;
};

/// The census of a picture (see censusRow()), row-major without gaps.
struct CensusPicture {
    const std::uint32_t* pixels;
    Size size;
};

/// Computes the matching costs of a row of pixels. `own`: census of these pixels. Each pixel has
/// kLabels * `vectors` successive labels, and `base` is the first of them. `out` is ordered by
/// pixel, then by label. The cost of a label is the Hamming distance between the pixel's census and
/// the census at the label's point in the still. It is half of the number of bits if the still has
/// no pixel there. With `slack`, the points one pixel to either side of the epipolar line are also
/// compared, and the smallest of the three costs counts. The line is treated as straight within
/// kLabels labels.
void labelCosts(const LabelLines& lines, const LabelRow& row, const std::int16_t* base,
                const std::uint32_t* own, const CensusPicture& still, int vectors, bool slack,
                std::uint8_t* out);

/// Computes the best label of each pixel with a fractional part. A label's cost was measured at the
/// nearest pixel of the still, up to 0.7 px away from the label's point on the epipolar line. So
/// the minimum is interpolated between the points of the line that are nearest to these pixels.
void labelPlaces(const LabelLines& lines, const LabelRow& row, const Valley* valleys, float* out);

/// Computes the label of each Valley's cost minimum with a fractional part. Two straight lines with
/// opposite slopes are laid through the costs of the best label and of its two neighbours. The
/// minimum is where the lines meet. (With these costs, a parabola would prefer whole labels.) The
/// result is the best label itself if a neighbour's cost is unknown.
void labelVertices(const Valley* valleys, std::size_t count, float* out);

}  // namespace mfar::simd
