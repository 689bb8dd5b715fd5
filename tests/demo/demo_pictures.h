#pragma once

#include "tests/demo/demo_run.h"

#include <opencv2/core.hpp>

#include <string_view>

namespace mfar::demo {

[[nodiscard]] std::string_view name(TileClass tileClass);

/// Enlarged video, result and truth side by side. Below each, one region is magnified: that in
/// which the enlarged video lacks most of the truth's detail.
[[nodiscard]] cv::Mat comparisonPicture(const Shown& shown);

/// The confidence of each video pixel (eq. 2 of the paper), from dark (0) to light (1), with a
/// scale.
[[nodiscard]] cv::Mat confidencePicture(const Shown& shown);

/// The result with the class of every tile as a colour, and a legend.
[[nodiscard]] cv::Mat tileClassPicture(const Shown& shown);

}  // namespace mfar::demo
