#pragma once

#include "base/image_view.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/bench/summary.h"

namespace mfar::bench {

/// Times per frame [ms], measured until all work is finished. If a member does not say otherwise, a
/// picture of two balls on a plane is warped to a camera that has turned by 2 degrees.
struct WarpTimes {
    Summary objects;     ///< balls that cover a ninth of the picture, with their shadows
    Summary whole;       ///< one ball that is larger than the picture
    Summary still;       ///< scene of `objects`, but the camera has not turned
    Summary newPicture;  ///< scene of `objects`: CPU work and upload of a new traced picture
    Summary remap;       ///< time of the peer: cv::remap, bilinear, of the whole picture
};

/// The first run does not count; `runs` runs follow. GLES needs a current context.
[[nodiscard]] WarpTimes measureWarp(Size size, int runs, EngineKind engine);

}  // namespace mfar::bench
