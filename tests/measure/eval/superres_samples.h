#pragma once

#include "hal/virtual/recording.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <optional>
#include <vector>

namespace mfar::eval {

/// A frame to measure on: its truth and the still it may use.
struct SuperResSample {
    RecordedImage video;
    RecordedImage still;
    std::optional<RecordedImage> second;  ///< another still, where there is one
    std::filesystem::path truth;
};

/// The frames with truth/highres, at most `limit` of them, 0 = all. One line per frame left out
/// goes to stderr. Throws EvalError when none is left.
[[nodiscard]] std::vector<SuperResSample> superResSamplesOf(const Recording& recording, int limit);

/// The truth, CV_8UC3 of the output's size. Throws EvalError when it has another or is too small
/// for a border, ImageFileError.
[[nodiscard]] cv::Mat loadHighRes(const SuperResSample& sample, const StereoRig& rig);

/// Border left out of every measure [output px].
inline constexpr int kSuperResBorder = 32;
/// The same memory.
[[nodiscard]] cv::Mat withoutBorder(const cv::Mat& picture);

}  // namespace mfar::eval
