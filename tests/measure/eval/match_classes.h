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
    cv::Mat flow;        ///< CV_32FC2 [video px], as Pipeline::readFlow()
    cv::Mat confidence;  ///< CV_32F, eq. 2, as Pipeline::readConfidence()
};

/// Confidence from which a pixel counts as well matched: both directions of the flow agree within a
/// video pixel.
inline constexpr float kWellMatched = 0.5F;
/// Smallest share of a picture that a class needs to be measured.
inline constexpr double kSmallestClass = 0.001;

/// Classes of pixels by what the still shows of them.
enum class MatchClass : unsigned char {
    Outside,    ///< its look-up leaves the still
    Unmatched,  ///< inside, but occluded there or matched with low confidence
    Matched,
};
inline constexpr int kMatchClasses = 3;

/// The class of every output pixel, CV_8U: that of the video pixel that contains it.
[[nodiscard]] cv::Mat matchClasses(const StereoRig& rig, Size output, const StillMatch& match);

/// One sentence on the classes, for the head of a table.
[[nodiscard]] std::string matchClassesHead();
/// For each class: its share of the pixels, and its gain in luma PSNR over bicubic [dB].
[[nodiscard]] std::vector<Column> matchClassColumns();
/// Luma pictures CV_64F, classes CV_8U, same size. A class has no gain if it is too small or if
/// either picture equals the truth there.
[[nodiscard]] std::vector<std::optional<double>> matchClassValues(const cv::Mat& classes,
                                                                  const cv::Mat& picture,
                                                                  const cv::Mat& bicubic,
                                                                  const cv::Mat& truth);

}  // namespace mfar::eval
