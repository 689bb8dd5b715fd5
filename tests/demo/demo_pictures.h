#pragma once

#include "tests/demo/demo_run.h"

#include <opencv2/core.hpp>

#include <string_view>

namespace mfar::demo {

[[nodiscard]] std::string_view name(TileClass tileClass);

/// Enlarged video, result and true picture side by side. Below each, the area in which the video
/// lacks most of the true picture's detail is magnified.
[[nodiscard]] cv::Mat comparisonPicture(const Shown& shown);

/// Confidence (eq. 2 of the paper) over the video, from dark (0) to light (1), with a scale.
[[nodiscard]] cv::Mat confidencePicture(const Shown& shown);

/// The result with the class of every tile as a colour, and a legend.
[[nodiscard]] cv::Mat tileClassPicture(const Shown& shown);

}  // namespace mfar::demo
