#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// How well a picture shows the part of a virtual object that should be visible.
struct OcclusionScore {
    double overlap = 0;  ///< intersection over union, [0, 1]; NaN: both pictures are empty
    double boundary =
        0;  ///< mean distance of the shown boundary from the true one [px]; NaN: one is empty
};

/// `shown`, `truth`: CV_8U, same size, not 0 where the object is visible. The boundary consists of
/// the object's pixels that have one of their four neighbours outside the object. The picture's
/// edge is not a boundary.
[[nodiscard]] OcclusionScore occlusionScore(const cv::Mat& shown, const cv::Mat& truth);

/// Share of an object's pixels that are shown in one of two pictures and hidden in the other.
/// `before`, `now`: visible share of each pixel, CV_32F, same size; a pixel counts as shown from a
/// half on. `silhouette`: number of the object's pixels; if it is 0, the result is NaN.
[[nodiscard]] double flicker(const cv::Mat& before, const cv::Mat& now, double silhouette);

}  // namespace mfar::eval
