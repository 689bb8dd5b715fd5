#pragma once

#include "base/geometry.h"
#include "base/gl/texture.h"
#include "pipeline/composite/pass_params.h"

namespace mfar {

/// Picture of the virtual objects alone, seen by the video camera at the output's resolution.
/// Borrowed: valid until its maker's next run.
struct VirtualLayer {
    /// RGBA8, premultiplied by coverage; Filter::Linear where it is not of the output's size.
    const gpu::Texture* colour = nullptr;
    /// R32F: z [m] along the camera's axis, lifted where a shadow is; 0 = nothing.
    const gpu::Texture* depth = nullptr;
    PixelRect bounds;  ///< covered pixels, empty = nothing
};

}  // namespace mfar
