#pragma once

#include "tests/demo/occlusion_run.h"

#include <opencv2/core.hpp>

namespace mfar::demo {

/// Measured depth, true depth and the error of depth, with their colour scales.
[[nodiscard]] cv::Mat depthPicture(const OcclusionRun& run);

/// Three pictures: the object over everything, the result, and the truth. Below each, the place at
/// which most of the object is hidden is magnified.
[[nodiscard]] cv::Mat occlusionPicture(const OcclusionRun& run);

}  // namespace mfar::demo
