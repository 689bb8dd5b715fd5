#pragma once

#include "pipeline/geometry.h"
#include "pipeline/gpu/texture.h"

#include <algorithm>

namespace mfar {

/// The least rectangle with both in it; an empty one adds nothing.
[[nodiscard]] inline PixelRect around(const PixelRect& a, const PixelRect& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

/// Picture of the virtual objects alone, seen by the video camera at the output's resolution.
/// Borrowed: valid until its maker's next run.
struct VirtualLayer {
    const gpu::Texture* colour = nullptr;  ///< RGBA8, premultiplied by coverage
    const gpu::Texture* depth = nullptr;   ///< R32F: z [m] along the camera's axis, 0 = nothing
    PixelRect bounds;                      ///< covered pixels, empty = nothing
};

}  // namespace mfar
