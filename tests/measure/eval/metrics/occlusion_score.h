#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

struct OcclusionScore {
    double overlap = 0;  ///< intersection over union, [0, 1]; NaN if both masks are empty
    /// Mean distance of the shown boundary from the true one [px]; NaN if one boundary is empty.
    double boundary = 0;
};

/// `shown`, `truth`: CV_8U, same size, not 0 where the object is visible. Boundary pixels are
/// pixels of the object with at least one of their four neighbours outside it. The picture's edge
/// is no boundary.
[[nodiscard]] OcclusionScore occlusionScore(const cv::Mat& shown, const cv::Mat& truth);

/// Share of an object's pixels that are shown in only one of two pictures. `before`, `now`: visible
/// share of each pixel, CV_32F, same size; from 0.5 on, a pixel counts as shown. `silhouette`:
/// number of the object's pixels; if it is 0, the result is NaN.
[[nodiscard]] double flicker(const cv::Mat& before, const cv::Mat& now, double silhouette);

}  // namespace mfar::eval
