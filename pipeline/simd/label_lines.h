#pragma once

#include "base/image_view.h"
#include "pipeline/simd/lens.h"
#include "pipeline/simd/path_costs.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Describes where a frame's pixels with given labels lie in the still's canvas. Inverse depth s =
/// perLabel * label, see EpipolarLens.
struct LabelLines {
    Lens lens;
    float tx, ty, tz;        ///< translation of points, in the frame's orientation
    float originX, originY;  ///< camera pixel at the canvas's first pixel
    float perLabel;
};

/// A row of the frame's pixels.
struct LabelRow {
    const float *raysX, *raysY;
    std::size_t width;
};

/// The census of a picture, rows without gaps.
struct CensusPicture {
    const std::uint32_t* pixels;
    Size size;
};

/// Costs of the pixels of a row, whose census is `own`, for kLabels * vectors labels from `base`
/// on; ordered by pixel, then by label. A cost is the Hamming distance to the census of the still's
/// nearest pixel, or half of the number of bits if the still has no pixel there. With `slack`, it
/// is the smallest of this cost and those one pixel to either side of the line. The lens is treated
/// as straight along a vector of labels, because that is short.
void labelCosts(const LabelLines& lines, const LabelRow& row, const std::int16_t* base,
                const std::uint32_t* own, const CensusPicture& still, int vectors, bool slack,
                std::uint8_t* out);

/// Labels of the pixels of a row, with a fractional part. A cost belongs to a pixel that lies up to
/// 0.7 px off the point of its label. So the fraction is measured between the points of the line
/// that are nearest to these pixels.
void labelPlaces(const LabelLines& lines, const LabelRow& row, const Valley* valleys, float* out);

/// Labels of valleys with a fractional part. Two straight lines are laid through the costs of a
/// label and of its neighbours; their vertex is the result. (A parabola would prefer whole labels
/// with such costs.)
void labelVertices(const Valley* valleys, std::size_t count, float* out);

}  // namespace mfar::simd
