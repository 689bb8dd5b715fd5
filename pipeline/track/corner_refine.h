#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <array>

namespace mfar {

/// Refines the corners of tag detections to fractions of a pixel.
/// Along each edge of the quad, the position of the steepest step is measured. Straight lines are
/// fitted to these positions in undistorted coordinates, where a tag's edges are straight for any
/// lens. The corners are the intersections of the lines.
/// The blur of a lens is symmetric in light but not in grey levels. Measured in grey levels, the
/// edges of a tag would be up to 0.25 px too far out or in, and all distances from tags would be
/// wrong accordingly.
class CornerRefiner {
public:
    /// gamma: exponent of the picture's encoding, grey level ~ light^(1 / gamma). It is about 2 for
    /// pictures that are made for viewing (nominally 2.2, but smoothing after the encoding lowers
    /// it), and 1 for a sensor that delivers raw values. Throws std::invalid_argument unless 0.2 <=
    /// gamma <= 5.
    explicit CornerRefiner(double gamma = 2);

    /// Refines the corners of `detection`. `luma`: the Gray8 picture of `camera`'s size in which
    /// the tag was found. The corners stay unchanged if too little of an edge is visible, or if a
    /// corner would move by more than two pixels.
    void refine(const ImageView& luma, const CameraModel& camera, TagDetection& detection) const;

private:
    std::array<double, 256> light_{};  ///< linear light of each grey level; 1 at 255
};

}  // namespace mfar
