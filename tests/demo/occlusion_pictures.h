#pragma once

#include "tests/demo/occlusion_run.h"

#include <opencv2/core.hpp>

namespace mfar::demo {

[[nodiscard]] cv::Mat depthPicture(const OcclusionRun& run);

/// The virtual object drawn over everything, the result, and the truth. Below each picture, a
/// magnified part, in which much of the object is hidden and much is visible.
[[nodiscard]] cv::Mat occlusionPicture(const OcclusionRun& run);

}  // namespace mfar::demo
