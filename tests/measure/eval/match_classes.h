#pragma once

#include "base/geometry.h"
#include "tests/measure/eval/report.h"

#include <opencv2/core.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// The product's match of a frame with the still, at video size.
struct StillMatch {
    cv::Mat flow;        ///< CV_32FC2 [video px], see Pipeline::readFlow()
    cv::Mat confidence;  ///< CV_32F, the paper's eq. 2, see Pipeline::readConfidence()
};

/// Pixels with at least this confidence count as well matched: both directions of the flow agree
/// within one video pixel.
inline constexpr float kWellMatched = 0.5F;
/// Smallest share of the picture's pixels with which a class is measured.
inline constexpr double kSmallestClass = 0.001;

/// Classes of pixels, by whether the still shows them.
enum class MatchClass : unsigned char {
    Outside,    ///< the flow leads outside the still
    Unmatched,  ///< inside the still, but occluded there or matched with low confidence
    Matched,
};
inline constexpr int kMatchClasses = 3;

/// The class of every output pixel, CV_8U. It is the class of the video pixel that contains it.
[[nodiscard]] cv::Mat matchClasses(const StereoRig& rig, Size output, const StillMatch& match);

/// One sentence that explains the classes, to stand above a table.
[[nodiscard]] std::string matchClassesHead();
/// Two columns for each class: its share of the pixels, and its gain in luma PSNR over bicubic
/// [dB].
[[nodiscard]] std::vector<Column> matchClassColumns();
/// Values of matchClassColumns(). Lumas are CV_64F and classes CV_8U, all of the same size. A class
/// has no gain if it is too small, or if one of the pictures equals the truth there.
[[nodiscard]] std::vector<std::optional<double>> matchClassValues(const cv::Mat& classes,
                                                                  const cv::Mat& picture,
                                                                  const cv::Mat& bicubic,
                                                                  const cv::Mat& truth);

}  // namespace mfar::eval
