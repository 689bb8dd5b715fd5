#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// How well a picture shows the part of a virtual object that should be visible.
struct OcclusionScore {
    double overlap = 0;  ///< intersection over union, [0, 1]; NaN: nothing should be visible, and
                         ///< nothing is shown
    double boundary =
        0;  ///< mean distance of the shown boundary from the true one [px]; NaN: one is empty
};

/// `shown`, `truth`: CV_8U, same size, not 0 where the object is visible. Boundary: the object's
/// pixels with one of their four neighbours outside the object; the picture's edge does not count.
[[nodiscard]] OcclusionScore occlusionScore(const cv::Mat& shown, const cv::Mat& truth);

/// Share of an object's pixels that are shown in one of two pictures and hidden in the other.
/// `before`, `now`: CV_32F, same size, visible share of each pixel; at least a half counts as
/// shown. `silhouette`: number of the object's pixels; 0: NaN.
[[nodiscard]] double flicker(const cv::Mat& before, const cv::Mat& now, double silhouette);

}  // namespace mfar::eval
