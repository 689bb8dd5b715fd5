#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <array>

namespace mfar {

/// Refines the corners of detections to sub-pixels. Along each edge of the quad, the place of the
/// steepest step is measured between pixels; straight lines are fitted to these places in
/// undistorted coordinates, where the edges of a tag are straight for any lens; their intersections
/// are the corners. A lens's blur is symmetric in light, not in grey levels: measured in grey
/// levels, the edges of a tag are up to 0.25 px too far out or in, and all its distances are wrong
/// accordingly.
class CornerRefiner {
public:
    /// gamma: grey level ~ light^(1 / gamma). About 2 for pictures made for viewing (nominally 2.2;
    /// smoothing after the encoding lowers it), 1 for a sensor that delivers raw values. Throws
    /// std::invalid_argument unless 0.2 <= gamma <= 5.
    explicit CornerRefiner(double gamma = 2);

    /// `luma`: the Gray8 picture of `camera`'s size that the tag was found in. The corners remain
    /// unchanged when too little of an edge is visible or a corner would move by more than two
    /// pixels.
    void refine(const ImageView& luma, const CameraModel& camera, TagDetection& detection) const;

private:
    std::array<double, 256> light_{};  ///< linear light per grey level, 1 at 255
};

}  // namespace mfar
