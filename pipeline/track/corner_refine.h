#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <array>

namespace mfar {

/// Refines the corners of tag detections to fractions of a pixel.
///
/// The steepest brightness step is measured along each edge of the quad. Straight lines are fitted
/// to these positions in undistorted coordinates, where a tag's edges are straight for any lens.
/// The corners are the intersections of the lines.
///
/// The blur of a lens is symmetric in light but not in grey levels. Edges measured in grey levels
/// would be up to 0.25 px too far out or in, and all distances from tags would be wrong
/// accordingly.
class CornerRefiner {
public:
    /// `gamma` is the exponent of the picture's encoding: grey level ~ light^(1 / gamma). It is
    /// about 2 for pictures made for viewing (nominally 2.2, but smoothing after the encoding
    /// lowers it), and 1 for raw values. Throws std::invalid_argument unless 0.2 <= gamma <= 5.
    explicit CornerRefiner(double gamma = 2);

    /// `luma` is the Gray8 picture of `camera`'s size in which the tag was found. The corners stay
    /// unchanged if too little of an edge is visible, or if a corner would move by more than two
    /// pixels.
    void refine(const ImageView& luma, const CameraModel& camera, TagDetection& detection) const;

private:
    std::array<double, 256> light_{};  ///< linear light of each grey level; 1 at 255
};

}  // namespace mfar
