#pragma once

#include "daemon/config.h"
#include "hal/virtual/recording.h"
#include "pipeline/traced_layer.h"

#include <opencv2/core.hpp>

#include <functional>

namespace mfar::demo {

/// Pictures of path-traced objects in a recording, CV_8UC3, B G R, at output size.
struct VirtualRun {
    cv::Mat moving;   ///< last frame of the recording, with an older traced picture warped to it
    cv::Mat atRest;   ///< same view, traced with all samples while the camera rested
    cv::Rect region;  ///< bounding box of the objects and their shadows [output px]
    TracedLayerCounters moved, rested;
};

/// Shows the objects of a configuration in a recording, with poses from its tags. `progress` gets
/// the number of processed frames and of all frames. The repetitions of the last frame, whose
/// number depends on the path tracer, count as many frames as the recording has. Needs a current GL
/// context. Throws std::runtime_error if no object is in view in the last frame.
[[nodiscard]] VirtualRun runVirtual(const Recording& recording, const Config& config,
                                    const std::function<void(int, int)>& progress);

/// Both pictures of `run`. Below each, the objects are magnified.
[[nodiscard]] cv::Mat virtualPicture(const VirtualRun& run);

}  // namespace mfar::demo
