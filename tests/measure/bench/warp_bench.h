#pragma once

#include "base/image_view.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/bench/summary.h"

namespace mfar::bench {

/// Time per frame, with all work finished, to warp a picture of two balls on a plane by 2 degrees.
struct WarpTimes {
    Summary objects;    ///< balls that cover a ninth of the picture, with their shadows
    Summary whole;      ///< a ball larger than the picture
    Summary still;      ///< as `objects`, with the camera at rest
    Summary reference;  ///< for `objects`: preparing a new traced picture on the CPU, and its
                        ///< upload
    Summary remap;      ///< the peer: cv::remap, bilinear, on the whole picture
};

/// GLES needs a current context. Makes `runs` runs after one that does not count.
[[nodiscard]] WarpTimes measureWarp(Size size, int runs, EngineKind engine);

}  // namespace mfar::bench
