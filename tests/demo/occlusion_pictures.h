#pragma once

#include "tests/demo/occlusion_run.h"

#include <opencv2/core.hpp>

namespace mfar::demo {

/// Depth, true depth and the error, with their scales.
[[nodiscard]] cv::Mat depthPicture(const OcclusionRun& run);

/// Three pictures: the object over everything, as composed, and the truth; below each, the place
/// where most of the object is hidden, magnified.
[[nodiscard]] cv::Mat occlusionPicture(const OcclusionRun& run);

}  // namespace mfar::demo
