#pragma once

#include "hal/virtual/recording.h"
#include "hal/virtual/synthetic_scene.h"
#include "pipeline/composite/virtual_object.h"
#include "pipeline/engine/engine.h"

#include <opencv2/core.hpp>

#include <functional>
#include <vector>

namespace mfar::demo {

/// Means over the frames that have a true depth, pose and picture, without the first eight frames.
struct OcclusionQuality {
    int frames = 0;
    double absrel = 0;        ///< median of |z - true z| / true z over pixels with known depth
    double completeness = 0;  ///< share of the picture with known depth
    double overlap = 0;       ///< intersection over union of the shown and the truly visible object
    double boundary = 0;      ///< mean distance of the shown outline from the true one [video px]
};

struct OcclusionShown {
    cv::Mat depth, trueDepth;  ///< inverse depths [1/unit of the poses] at video size; 0: unknown
    cv::Mat overlaid;          ///< the true picture with the object drawn over everything
    cv::Mat composite, trueComposite;
    cv::Mat visible;  ///< CV_8U at output size; 255 where the virtual object should be visible
    cv::Mat hidden;   ///< CV_8U at output size; 255 where a real object hides the virtual object
};

struct OcclusionRun {
    OcclusionQuality quality;
    OcclusionShown last;
};

/// Shows objects in a recording of a synthetic scene, with poses found from the scene's tags. Depth
/// is computed in the whole picture, not only near objects. All steps run on `engine`. `progress`
/// gets the number of processed frames and of all frames. Needs a current GL context. Throws
/// std::runtime_error if the last frame has no true depth, pose or picture, or is one of the first
/// eight frames.
[[nodiscard]] OcclusionRun runOcclusion(const Recording& recording, synthetic::Scene scene,
                                        const std::vector<VirtualObject>& objects,
                                        EngineKind engine,
                                        const std::function<void(int, int)>& progress);

}  // namespace mfar::demo
