#pragma once

#include "base/geometry.h"
#include "base/gl/texture.h"
#include "pipeline/composite/pass_params.h"

namespace mfar {

/// Picture of the virtual objects only, seen by the video camera at the output's resolution.
/// Borrowed: valid until the next run of the class that made it.
struct VirtualLayer {
    /// RGBA8, premultiplied by coverage; Filter::Linear if its size differs from the output's.
    const gpu::Texture* colour = nullptr;
    /// R32F: z along the camera's axis [m], reduced for shadows (kShadowLift); 0 = nothing.
    const gpu::Texture* depth = nullptr;
    PixelRect bounds;  ///< covered pixels, empty = nothing
};

}  // namespace mfar
