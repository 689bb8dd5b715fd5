#pragma once

#include "base/image_view.h"
#include "pipeline/simd/lens.h"
#include "pipeline/simd/path_costs.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// A label is an inverse depth, counted in steps: s = perLabel * label, see EpipolarLens.
/// LabelLines describes where the still's canvas shows a frame's pixels with given labels.
struct LabelLines {
    Lens lens;
    float tx, ty, tz;        ///< translation of points, in the frame's orientation
    float originX, originY;  ///< the still camera's pixel at pixel (0, 0) of the canvas
    float perLabel;
};

/// A row of the frame's pixels.
struct LabelRow {
    const float *raysX, *raysY;
    std::size_t width;
};

/// The census (see censusRow()) of a picture, rows without gaps.
struct CensusPicture {
    const std::uint32_t* pixels;
    Size size;
};

/// Computes the matching costs of a row's pixels, whose census is `own`, for kLabels * vectors
/// labels from each pixel's `base` on; ordered by pixel, then by label. A cost is the Hamming
/// distance to the census of the still's nearest pixel, or half of the number of bits if the still
/// has no pixel there. With `slack`, it is the smallest of this cost and the costs one pixel to
/// either side of the epipolar line. The line is treated as straight over a vector of labels,
/// because that part of it is short.
void labelCosts(const LabelLines& lines, const LabelRow& row, const std::int16_t* base,
                const std::uint32_t* own, const CensusPicture& still, int vectors, bool slack,
                std::uint8_t* out);

/// Computes the best labels of a row's pixels, with a fractional part. A label's cost is that of a
/// still pixel up to 0.7 px away from the label's point on the epipolar line. So the fraction is
/// measured between the points of the line that are nearest to these pixels.
void labelPlaces(const LabelLines& lines, const LabelRow& row, const Valley* valleys, float* out);

/// Computes the labels of cost minima with a fractional part. Two straight lines are laid through
/// the costs of a label and of its two neighbours; the result is where they meet. (A parabola would
/// prefer whole labels with such costs.)
void labelVertices(const Valley* valleys, std::size_t count, float* out);

}  // namespace mfar::simd
