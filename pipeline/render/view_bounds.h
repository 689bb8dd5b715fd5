#pragma once

#include "pipeline/render/lens_rays.h"
#include "pipeline/render/render_view.h"

#include <Eigen/Geometry>

namespace mfar {

/// Rectangle around the pixels that see a point of a world box; may be larger. Points behind the
/// camera are not seen. `rays` are those of the view.
[[nodiscard]] PixelRect pixelsOfBox(const Eigen::AlignedBox3f& box, const RenderView& view,
                                    const LensRays& rays);

}  // namespace mfar
