#pragma once

#include "hal/virtual/recording.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <optional>
#include <vector>

namespace mfar::eval {

/// A frame to measure, its truth, and the stills that methods may use.
struct SuperResSample {
    RecordedImage video;
    RecordedImage still;
    std::optional<RecordedImage> second;
    std::filesystem::path truth;
};

/// Finds the frames with truth/highres, at most `limit` (0: all). Frames without a suitable still
/// are skipped, and a line on stderr reports each. If `needsStill` is false, they are kept; their
/// member `still` is then the frame itself and must not be used. Throws EvalError if no frame
/// remains.
[[nodiscard]] std::vector<SuperResSample> superResSamplesOf(const Recording& recording, int limit,
                                                            bool needsStill = true);

/// Loads the true picture, CV_8UC3 of the output's size. Throws ImageFileError, and EvalError if
/// the size differs or is too small for the border.
[[nodiscard]] cv::Mat loadHighRes(const SuperResSample& sample, const StereoRig& rig);

/// Width of the border that no metric counts [output px].
inline constexpr int kSuperResBorder = 32;
[[nodiscard]] cv::Mat withoutBorder(const cv::Mat& picture);

}  // namespace mfar::eval
