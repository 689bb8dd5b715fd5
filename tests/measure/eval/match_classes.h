#pragma once

#include "base/geometry.h"
#include "tests/measure/eval/report.h"

#include <opencv2/core.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

struct StillMatch {
    cv::Mat flow;        ///< CV_32FC2 [video px], see Pipeline::readFlow()
    cv::Mat confidence;  ///< CV_32F, the paper's eq. 2, see Pipeline::readConfidence()
};

/// Least confidence of a matched pixel. At this confidence, both directions of the flow agree
/// within one video pixel.
inline constexpr float kWellMatched = 0.5F;
/// Smallest share of the picture's pixels for which a class's gain is measured.
inline constexpr double kSmallestClass = 0.001;

enum class MatchClass : unsigned char {
    Outside,
    Unmatched,  ///< inside the still, but occluded there or matched with low confidence
    Matched,
};
inline constexpr int kMatchClasses = 3;

/// Class of each output pixel, CV_8U: that of the video pixel which contains it.
[[nodiscard]] cv::Mat matchClasses(const StereoRig& rig, Size output, const StillMatch& match);

[[nodiscard]] std::string matchClassesHead();
/// Columns of each class: its share of the pixels, and its gain in luma PSNR over bicubic [dB].
[[nodiscard]] std::vector<Column> matchClassColumns();
/// Values of matchClassColumns(). Lumas are CV_64F, classes CV_8U, all of the same size. The gain
/// of a class is empty if its share is below kSmallestClass, or if `picture` or `bicubic` equals
/// the truth in all pixels of the class.
[[nodiscard]] std::vector<std::optional<double>> matchClassValues(const cv::Mat& classes,
                                                                  const cv::Mat& picture,
                                                                  const cv::Mat& bicubic,
                                                                  const cv::Mat& truth);

}  // namespace mfar::eval
