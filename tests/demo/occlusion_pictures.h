#pragma once

#include "tests/demo/occlusion_run.h"

#include <opencv2/core.hpp>

namespace mfar::demo {

/// Depth, its truth and how far they are apart, with their scales.
[[nodiscard]] cv::Mat depthPicture(const OcclusionRun& run);

/// The object over everything, as composed, and as it should be, and below each the place where
/// most of it is hidden, magnified.
[[nodiscard]] cv::Mat occlusionPicture(const OcclusionRun& run);

}  // namespace mfar::demo
