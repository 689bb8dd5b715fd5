#pragma once

#include "base/image_view.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/bench/summary.h"

namespace mfar::bench {

/// Times per frame [ms] until all work is finished.
struct WarpTimes {
    Summary objects;     ///< balls and shadows on a ninth of the picture; view turned by 2 degrees
    Summary whole;       ///< one ball that fills the whole picture; view turned by 2 degrees
    Summary still;       ///< scene of `objects`, shown in the view in which it was traced
    Summary newPicture;  ///< CPU work and upload when the picture of `objects` is replaced
    Summary remap;       ///< peer: cv::remap of the whole picture, bilinear
};

/// Measures each quantity in `runs` runs, after one run to warm up. GLES needs a current context.
[[nodiscard]] WarpTimes measureWarp(Size size, int runs, EngineKind engine);

}  // namespace mfar::bench
