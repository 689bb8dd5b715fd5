#pragma once

#include "base/image_view.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/bench/summary.h"

namespace mfar::bench {

/// Times per frame [ms] until all work is finished. If a member does not say otherwise, a picture
/// of two balls on a plane is warped to a camera that has turned by 2 degrees.
struct WarpTimes {
    Summary objects;  ///< balls with shadows that cover a ninth of the picture
    Summary whole;
    Summary still;       ///< like `objects`, but the camera has not turned
    Summary newPicture;  ///< like `objects`: CPU work and upload of a new traced picture
    Summary remap;       ///< peer: cv::remap of the whole picture, bilinear
};

/// Makes `runs` runs after one that warms up. GLES needs a current context.
[[nodiscard]] WarpTimes measureWarp(Size size, int runs, EngineKind engine);

}  // namespace mfar::bench
