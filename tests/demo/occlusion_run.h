#pragma once

#include "hal/virtual/recording.h"
#include "hal/virtual/synthetic_scene.h"
#include "pipeline/composite/virtual_object.h"

#include <opencv2/core.hpp>

#include <functional>
#include <vector>

namespace mfar::demo {

/// Means over the frames that have a truth, from the eighth on.
struct OcclusionQuality {
    int frames = 0;
    double absrel = 0;        ///< median over the picture of |z - true z| / true z
    double completeness = 0;  ///< share of the picture whose depth is known
    double overlap = 0;       ///< of what is seen of the object with what should be: IoU
    double boundary = 0;      ///< mean distance of its boundary from the true one [video px]
};

/// One frame. Depths: CV_32F, 1/z [1/m] per video pixel, 0 = unknown. Pictures: CV_8UC3, B G R, at
/// output size.
struct OcclusionShown {
    cv::Mat depth, trueDepth;
    cv::Mat overlaid;  ///< the true picture, the object over everything
    cv::Mat composite, trueComposite;
    cv::Mat visible, hidden;  ///< CV_8U at output size, 255: what should be of the object
};

struct OcclusionRun {
    OcclusionQuality quality;
    OcclusionShown last;  ///< the last frame
};

/// Shows objects in a recording of a synthetic scene, with the poses that its tags give, and
/// measures depth in the whole picture. Needs a current GL context. `progress` gets the frames done
/// and in total. Throws std::runtime_error when the last frame has no truth.
[[nodiscard]] OcclusionRun runOcclusion(const Recording& recording, synthetic::Scene scene,
                                        const std::vector<VirtualObject>& objects,
                                        const std::function<void(int, int)>& progress);

}  // namespace mfar::demo
