#pragma once

#include "tests/demo/demo_run.h"

#include <opencv2/core.hpp>

#include <string_view>

namespace mfar::demo {

[[nodiscard]] std::string_view name(TileClass tileClass);

/// Upscaled video, result and truth side by side, and below each the place where the video lacks
/// most of the truth's detail, magnified.
[[nodiscard]] cv::Mat comparisonPicture(const Shown& shown);

/// Eq. 2 over the video, from dark (0) to light (1), with its scale.
[[nodiscard]] cv::Mat confidencePicture(const Shown& shown);

/// The class of every tile as a colour over the result, with a legend.
[[nodiscard]] cv::Mat tileClassPicture(const Shown& shown);

}  // namespace mfar::demo
