#pragma once

#include "base/geometry.h"
#include "base/gl/texture.h"
#include "pipeline/composite/pass_params.h"

namespace mfar {

/// A picture of only the virtual objects, as the video camera sees them. The textures belong to the
/// renderer that drew them and are valid until it draws again.
struct VirtualLayer {
    /// RGBA8, premultiplied by coverage. The texture's filter is Filter::Linear if its size differs
    /// from the size of the output.
    const gpu::Texture* colour = nullptr;
    /// R32F: z along the camera's axis [m]; 0 where there is no surface. The z of shadows is
    /// reduced, see kShadowLift.
    const gpu::Texture* depth = nullptr;
    PixelRect bounds;
};

}  // namespace mfar
