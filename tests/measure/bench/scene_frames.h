#pragma once

#include "tests/measure/eval/scene_run.h"

#include <opencv2/core.hpp>

#include <optional>

namespace mfar::bench {

/// Sizes of the pictures with the option --quick.
inline constexpr Size kQuickVideo{160, 120}, kQuickStill{576, 432};

/// A frame, and the still that arrived before it, if any; R G B A. They are rendered before a
/// measurement starts, because the synthetic board renders in threads of this process, which would
/// slow the measurement.
struct SceneFrame {
    cv::Mat picture, still;
    Timestamp time;
    std::optional<Pose> pose, stillPose;
};

[[nodiscard]] SceneFrame nextFrame(eval::SceneRun& scene);

}  // namespace mfar::bench
