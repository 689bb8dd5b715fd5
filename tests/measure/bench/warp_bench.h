#pragma once

#include "base/image_view.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/bench/summary.h"

namespace mfar::bench {

/// A finished picture of two balls on a plane, turned by 2 degrees, a frame: until it is
/// finished.
struct WarpTimes {
    Summary objects;    ///< balls that fill a ninth of the picture, with their shadows
    Summary whole;      ///< a ball larger than the picture
    Summary still;      ///< as `objects`, the camera at rest
    Summary reference;  ///< of `objects`: making a new picture ready, on the host, and its upload
    Summary remap;      ///< the peer: cv::remap, bilinear, of the whole picture
};

/// For GLES a context has to be current. `runs` after one that does not count.
[[nodiscard]] WarpTimes measureWarp(Size size, int runs, EngineKind engine);

}  // namespace mfar::bench
