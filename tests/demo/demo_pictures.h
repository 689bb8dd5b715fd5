#pragma once

#include "tests/demo/demo_run.h"

#include <opencv2/core.hpp>

#include <string_view>

namespace mfar::demo {

[[nodiscard]] std::string_view name(TileClass tileClass);

/// Enlarged video, result and truth side by side. Below each picture, a magnified part: the region
/// in which the enlarged video lacks most detail.
[[nodiscard]] cv::Mat comparisonPicture(const Shown& shown);

[[nodiscard]] cv::Mat confidencePicture(const Shown& shown);

[[nodiscard]] cv::Mat tileClassPicture(const Shown& shown);

}  // namespace mfar::demo
