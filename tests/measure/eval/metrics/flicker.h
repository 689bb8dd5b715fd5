#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Flicker of scene points from one picture to the next [grey levels]: the RMS change of a point's
/// error along the true motion, divided by the square root of two. For independent errors and a
/// motion of whole pixels, this is their standard deviation. For a motion by fractions of a pixel,
/// the error in the second picture is interpolated, which reduces independent errors: the result is
/// then up to 21 % lower. An error that stays with its point does not count.
///
/// `before`, `after`: errors of two consecutive pictures, CV_64F, same size, without a border of
/// `border` pixels. `flow`: CV_32FC2 of the video's size, from the first picture to the second
/// [video px]; unknown if not finite or above 1e9. Returns NaN if no point is in both pictures.
[[nodiscard]] double flicker(const cv::Mat& before, const cv::Mat& after, const cv::Mat& flow,
                             int border);

}  // namespace mfar::eval
