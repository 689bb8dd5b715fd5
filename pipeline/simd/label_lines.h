#pragma once

#include "base/image_view.h"
#include "pipeline/simd/lens.h"
#include "pipeline/simd/path_costs.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// A label is an inverse depth, counted in steps: s = perLabel * label, see EpipolarLens.
/// LabelLines projects a frame's pixels with given labels to the still's canvas: the still, drawn
/// with the lens and the orientation of the frame's camera (TurnedPicture).
struct LabelLines {
    Lens lens;
    float tx, ty, tz;        ///< translation of points, in the axes of the frame's camera
    float originX, originY;  ///< pixel of `lens` at the canvas's pixel (0, 0)
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

/// Computes the matching costs of a row's pixels, whose census is `own`. Each pixel has kLabels *
/// vectors labels, from its `base` on; costs are ordered by pixel, then by label. A cost is the
/// Hamming distance to the census of the still's nearest pixel, or half of the number of bits if
/// the still has no pixel there. With `slack`, it is the smallest of this cost and of the costs one
/// pixel to either side of the epipolar line. The line is treated as straight within a vector of
/// labels.
void labelCosts(const LabelLines& lines, const LabelRow& row, const std::int16_t* base,
                const std::uint32_t* own, const CensusPicture& still, int vectors, bool slack,
                std::uint8_t* out);

/// Computes the best label of each pixel, with a fractional part. A label's cost is that of the
/// nearest still pixel, which is up to 0.7 px away from the label's point on the epipolar line. So
/// the fraction is measured between the points of the line that are nearest to these pixels.
void labelPlaces(const LabelLines& lines, const LabelRow& row, const Valley* valleys, float* out);

/// Computes the labels of cost minima, with a fractional part. The minimum is where two straight
/// lines meet that run through the costs of the best label and its two neighbours. (A parabola
/// would prefer whole labels with such costs.)
void labelVertices(const Valley* valleys, std::size_t count, float* out);

}  // namespace mfar::simd
