#pragma once

#include "daemon/config.h"
#include "hal/virtual/recording.h"
#include "pipeline/traced_layer.h"

#include <opencv2/core.hpp>

#include <functional>

namespace mfar::demo {

/// Path traced objects in a recording. Pictures: CV_8UC3, B G R, at output size.
struct VirtualRun {
    cv::Mat moving;   ///< the last frame, a reference picture warped to it
    cv::Mat atRest;   ///< the same after the camera stayed there, with all samples
    cv::Rect region;  ///< around the objects and their shadows [output px]
    TracedLayerCounters moved, rested;
};

/// Shows the configuration's objects with the poses that the recording's tags give. Needs a current
/// GL context. `progress` gets the frames done and in total. Throws std::runtime_error when no
/// object is in view at the end.
[[nodiscard]] VirtualRun runVirtual(const Recording& recording, const Config& config,
                                    const std::function<void(int, int)>& progress);

/// Both pictures, and below each the objects magnified.
[[nodiscard]] cv::Mat virtualPicture(const VirtualRun& run);

}  // namespace mfar::demo
