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
    Summary still;       ///< as `objects`, but the camera is at rest
    Summary newPicture;  ///< as `objects`: CPU work for a new traced picture, with its upload
    Summary remap;       ///< the peer: cv::remap, bilinear, on the whole picture
};

/// The first run does not count; `runs` runs follow. GLES needs a current context.
[[nodiscard]] WarpTimes measureWarp(Size size, int runs, EngineKind engine);

}  // namespace mfar::bench
