#pragma once

#include "pipeline/geometry.h"
#include "pipeline/gpu/texture.h"

namespace mfar {

/// Picture of the virtual objects alone, seen by the video camera at the output's resolution.
/// Borrowed: valid until its maker's next run.
struct VirtualLayer {
    const gpu::Texture* colour = nullptr;  ///< RGBA8, premultiplied by coverage
    const gpu::Texture* depth = nullptr;   ///< R32F: z [m] along the camera's axis, 0 = nothing
    PixelRect bounds;                      ///< covered pixels, empty = nothing
};

}  // namespace mfar
