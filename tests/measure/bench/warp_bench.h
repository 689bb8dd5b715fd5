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
    Summary still;       ///< picture of `objects`, warped to the view in which it was traced
    Summary newPicture;  ///< CPU work and upload when the picture of `objects` is replaced
    Summary remap;       ///< peer: cv::remap of the whole picture, bilinear
};

/// Makes `runs` runs after one that warms up. GLES needs a current context.
[[nodiscard]] WarpTimes measureWarp(Size size, int runs, EngineKind engine);

}  // namespace mfar::bench
