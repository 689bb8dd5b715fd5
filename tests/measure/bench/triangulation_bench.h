#pragma once

#include "base/image_view.h"

namespace mfar::bench {

/// Time to triangulate one point, the median of several runs [ns].
struct TriangulationTimes {
    double flow = 0, midpoint = 0;  ///< the product's two methods on every video pixel, one thread
    double opencv = 0;              ///< cv::triangulatePoints, on undistorted points
};

/// Triangulates the flow of a hand-held camera with distorting lenses. The methods run in turn.
[[nodiscard]] TriangulationTimes measureTriangulation(Size video);

}  // namespace mfar::bench
