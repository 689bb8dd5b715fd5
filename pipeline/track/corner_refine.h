#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <array>

namespace mfar {

/// Refines the corners of tag detections to fractions of a pixel.
///
/// Along each edge of the quad, the positions of the brightness step are measured. They are
/// undistorted, because only then the edges of a tag are straight for any lens. A straight line is
/// fitted to the positions of each edge. The corners are the intersections of these lines.
///
/// Brightness is measured in linear light, because the blur of a lens is symmetric in light but not
/// in grey levels. Edges measured in grey levels would be up to 0.25 px too far out or in, and the
/// computed distances of all tags would be wrong.
class CornerRefiner {
public:
    /// `gamma` describes the picture's encoding: grey level ~ light^(1 / gamma). For raw values, it
    /// is 1. For pictures made for viewing, it is about 2. (The nominal value is 2.2, but smoothing
    /// after the encoding lowers it.) Throws std::invalid_argument unless 0.2 <= gamma <= 5.
    explicit CornerRefiner(double gamma = 2);

    /// Refines the corners of `detection`. `luma` is the Gray8 picture in which the tag was found,
    /// with the size of `camera`. The corners stay unchanged if the tag is too small, if too little
    /// of an edge is visible, or if a corner would move by two pixels or more.
    void refine(const ImageView& luma, const CameraModel& camera, TagDetection& detection) const;

private:
    std::array<double, 256> light_{};  ///< linear light of each grey level; 1 at 255
};

}  // namespace mfar
