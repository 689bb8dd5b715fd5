#pragma once

#include "base/image_view.h"

namespace mfar::bench {

/// Median time to triangulate one point [ns].
struct TriangulationTimes {
    double flow = 0, midpoint = 0;  ///< methods of Triangulation, every video pixel, one thread
    double opencv = 0;              ///< cv::triangulatePoints, on undistorted points
};

/// Triangulates the flow between two views of one camera with lens distortion. Each round times all
/// methods, one after the other.
[[nodiscard]] TriangulationTimes measureTriangulation(Size video);

}  // namespace mfar::bench
