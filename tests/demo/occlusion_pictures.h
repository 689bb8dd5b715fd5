#pragma once

#include "tests/demo/occlusion_run.h"

#include <opencv2/core.hpp>

namespace mfar::demo {

[[nodiscard]] cv::Mat depthPicture(const OcclusionRun& run);

/// The virtual object drawn over everything, the result, and the truth. Below each, the region in
/// which most of the object is hidden is magnified.
[[nodiscard]] cv::Mat occlusionPicture(const OcclusionRun& run);

}  // namespace mfar::demo
