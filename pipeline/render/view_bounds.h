#pragma once

#include "pipeline/render/lens_rays.h"
#include "pipeline/render/render_view.h"

#include <Eigen/Geometry>

namespace mfar {

/// Pixels that see a point of a world box, or a few more; what is behind the camera is not seen.
/// `rays` are the view's.
[[nodiscard]] PixelRect pixelsOfBox(const Eigen::AlignedBox3f& box, const RenderView& view,
                                    const LensRays& rays);

}  // namespace mfar
