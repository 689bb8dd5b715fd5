#pragma once

#include "hal/virtual/recording.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <optional>
#include <vector>

namespace mfar::eval {

/// A frame to measure: its truth and the stills that may be used.
struct SuperResSample {
    RecordedImage video;
    RecordedImage still;
    std::optional<RecordedImage> second;  ///< another still, if there is one
    std::filesystem::path truth;
};

/// The frames with truth/highres, at most `limit` of them, 0 = all. Prints one line per skipped
/// frame to stderr. Throws EvalError if none remains.
[[nodiscard]] std::vector<SuperResSample> superResSamplesOf(const Recording& recording, int limit);

/// The truth, CV_8UC3 of the output's size. Throws EvalError if the size differs or is too small
/// for a border, and ImageFileError.
[[nodiscard]] cv::Mat loadHighRes(const SuperResSample& sample, const StereoRig& rig);

/// Border excluded from every metric [output px].
inline constexpr int kSuperResBorder = 32;
/// Shares the picture's memory.
[[nodiscard]] cv::Mat withoutBorder(const cv::Mat& picture);

}  // namespace mfar::eval
