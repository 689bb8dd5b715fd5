#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// How much places of a scene flicker from one picture to the next: root mean square of how the
/// error changes along the true motion, over the square root of two, which is the deviation of
/// independent errors. What moves, and light that changes, is in both errors and does not count;
/// an error that stays with its place does not, either. [grey levels]
///
/// `before`, `after`: errors of two pictures in a row, CV_64F of the same size, `border` pixels of
/// all sides of the picture cut off. `flow`: CV_32FC2 of the video's size, from the first to the
/// second [video px]; not finite or beyond 1e9: unknown. NaN where no place is in both.
[[nodiscard]] double flicker(const cv::Mat& before, const cv::Mat& after, const cv::Mat& flow,
                             int border);

}  // namespace mfar::eval
