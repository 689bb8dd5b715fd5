#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Flicker of scene points from one picture to the next: root mean square of the change of the
/// error along the true motion, over the square root of two. For independent errors that is their
/// standard deviation. Moving objects and changing light are in both errors and do not count, nor
/// does an error that stays with its point. [grey levels]
///
/// `before`, `after`: errors of two consecutive pictures, CV_64F, same size, with `border` pixels
/// cut off at all sides. `flow`: CV_32FC2 of the video's size, from the first to the second [video
/// px]; not finite or above 1e9: unknown. NaN if no point is in both.
[[nodiscard]] double flicker(const cv::Mat& before, const cv::Mat& after, const cv::Mat& flow,
                             int border);

}  // namespace mfar::eval
