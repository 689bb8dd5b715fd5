#pragma once

#include "base/geometry.h"
#include "tests/measure/eval/report.h"

#include <opencv2/core.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// What the product's match says of a frame, at video size.
struct StillMatch {
    cv::Mat flow;        ///< CV_32FC2 [video px], as Pipeline::readFlow()
    cv::Mat confidence;  ///< CV_32F, eq. 2, as Pipeline::readConfidence()
};

/// Confidence from which on a pixel is well matched: both ways of the flow agree to a video pixel.
inline constexpr float kWellMatched = 0.5F;
/// Share of a picture below which a class is too small to be measured.
inline constexpr double kSmallestClass = 0.001;

/// By what the still can say of a pixel.
enum class MatchClass : unsigned char {
    Outside,    ///< its look-up leaves the still
    Unmatched,  ///< inside, but hidden there or not found with confidence
    Matched,
};
inline constexpr int kMatchClasses = 3;

/// The class of every output pixel, CV_8U: that of the video pixel that it lies in.
[[nodiscard]] cv::Mat matchClasses(const StereoRig& rig, Size output, const StillMatch& match);

/// One sentence on the classes, for the head of a table.
[[nodiscard]] std::string matchClassesHead();
/// Of each class: its share of the pixels, and the luma PSNR over bicubic there [dB].
[[nodiscard]] std::vector<Column> matchClassColumns();
/// Luma pictures CV_64F, classes CV_8U, same size. No gain of a class that is too small, and none
/// where either picture equals the truth.
[[nodiscard]] std::vector<std::optional<double>> matchClassValues(const cv::Mat& classes,
                                                                  const cv::Mat& picture,
                                                                  const cv::Mat& bicubic,
                                                                  const cv::Mat& truth);

}  // namespace mfar::eval
