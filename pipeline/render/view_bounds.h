#pragma once

#include "pipeline/render/lens_rays.h"
#include "pipeline/render/render_view.h"

#include <Eigen/Geometry>

namespace mfar {

/// Rectangle around the pixels that see a point of a box in the world. It may be larger than
/// necessary. Points behind the camera are not visible. `rays` must belong to `view`.
[[nodiscard]] PixelRect pixelsOfBox(const Eigen::AlignedBox3f& box, const RenderView& view,
                                    const LensRays& rays);

}  // namespace mfar
