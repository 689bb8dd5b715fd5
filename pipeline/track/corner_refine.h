#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <array>

namespace mfar {

/// Sharpens the corners of detections: along each edge of the quad the place of the steepest step
/// is measured between pixels, straight lines are fitted to these places in undistorted
/// coordinates, where the edges of a tag are straight whatever the lens, and intersected. The blur
/// of a lens is symmetric in light, not in grey levels: measured in grey levels the edges of a tag
/// sit up to 0.25 px too far out or in, and all its distances are wrong with them.
class CornerRefiner {
public:
    /// gamma: grey level ~ light^(1 / gamma). About 2 for pictures made to be looked at (2.2 on
    /// paper; what is smoothed after the encoding brings it down), 1 for a sensor that gives raw
    /// values. Throws std::invalid_argument unless 0.2 <= gamma <= 5.
    explicit CornerRefiner(double gamma = 2);

    /// `luma`: the Gray8 picture of `camera`'s size that the tag was found in. The corners stay
    /// where they are when too little of an edge is seen or one would move by more than two pixels.
    void refine(const ImageView& luma, const CameraModel& camera, TagDetection& detection) const;

private:
    std::array<double, 256> light_{};  ///< of a grey level, 1 at 255
};

}  // namespace mfar
