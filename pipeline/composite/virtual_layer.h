#pragma once

#include "base/geometry.h"
#include "base/gl/texture.h"
#include "pipeline/composite/pass_params.h"

namespace mfar {

/// A picture of the virtual objects only, seen by the video camera at the output's resolution. The
/// textures are owned by the class that drew them and valid until its next run.
struct VirtualLayer {
    /// RGBA8, premultiplied by coverage. Has Filter::Linear if its size differs from the output's.
    const gpu::Texture* colour = nullptr;
    /// R32F: z along the camera's axis [m], reduced for shadows (kShadowLift); 0: no surface.
    const gpu::Texture* depth = nullptr;
    PixelRect bounds;  ///< bounds of the covered pixels; empty: nothing is drawn
};

}  // namespace mfar
