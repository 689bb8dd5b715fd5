#pragma once

#include "base/geometry.h"
#include "pipeline/composite/pass_values.h"
#include "pipeline/warp/pass_params.h"

#include <Eigen/Geometry>

namespace mfar {

/// Rectangle that contains all pixels of a picture that are within `margin` px of `box`. Its sides
/// are at most one pixel farther out. Empty if the picture has no pixels there.
[[nodiscard]] PixelRect pixelsAround(const Eigen::AlignedBox2d& box, int margin, Size picture);

}  // namespace mfar
