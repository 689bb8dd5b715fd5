#pragma once

#include "daemon/config.h"
#include "hal/virtual/recording.h"
#include "pipeline/traced_layer.h"

#include <opencv2/core.hpp>

#include <functional>

namespace mfar::demo {

/// Results of path-traced objects in a recording. Pictures are CV_8UC3, B G R, at output size.
struct VirtualRun {
    cv::Mat moving;   ///< the last frame: a traced picture, warped to its view
    cv::Mat atRest;   ///< the same view after the camera rested, with all samples
    cv::Rect region;  ///< contains the objects and their shadows [output px]
    TracedLayerCounters moved, rested;
};

/// Shows the objects of a configuration with the poses that the recording's tags give. `progress`
/// gets the number of frames done and the total. Needs a current GL context. Throws
/// std::runtime_error if no object is in view at the end.
[[nodiscard]] VirtualRun runVirtual(const Recording& recording, const Config& config,
                                    const std::function<void(int, int)>& progress);

/// Both pictures. Below each, the objects are magnified.
[[nodiscard]] cv::Mat virtualPicture(const VirtualRun& run);

}  // namespace mfar::demo
