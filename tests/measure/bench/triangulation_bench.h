#pragma once

#include "base/image_view.h"

namespace mfar::bench {

/// Time to triangulate a point, median of several runs [ns].
struct TriangulationTimes {
    double flow = 0, midpoint = 0;  ///< ours, every pixel of the video, one thread
    double opencv = 0;              ///< cv::triangulatePoints, on undistorted points
};

/// Of a hand-held camera's flow, with bent lenses; runs in turn.
[[nodiscard]] TriangulationTimes measureTriangulation(Size video);

}  // namespace mfar::bench
