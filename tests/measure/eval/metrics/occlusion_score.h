#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// How well a picture shows of a virtual object what should be seen of it.
struct OcclusionScore {
    double overlap = 0;  ///< intersection over union, [0, 1]; NaN: nothing to see, and none shown
    double boundary =
        0;  ///< mean distance of its boundary from the true one [px]; NaN: one is empty
};

/// `shown`, `truth`: CV_8U of the same size, not 0 where the object is seen. Boundary: the pixels
/// of the object with one of their four neighbours outside; the picture's edge is none.
[[nodiscard]] OcclusionScore occlusionScore(const cv::Mat& shown, const cv::Mat& truth);

/// Share of an object's pixels that are shown in one of two pictures and hidden in the other.
/// `before`, `now`: CV_32F of the same size, how much of each pixel is shown, at least a half
/// counts. `silhouette`: how many of these pixels the object has; 0: NaN.
[[nodiscard]] double flicker(const cv::Mat& before, const cv::Mat& now, double silhouette);

}  // namespace mfar::eval
