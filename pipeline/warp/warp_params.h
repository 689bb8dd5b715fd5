#pragma once

#include "base/geometry.h"
#include "pipeline/composite/pass_values.h"
#include "pipeline/warp/pass_params.h"

#include <Eigen/Geometry>

namespace mfar {

/// Rectangle around a picture's pixels within `margin` px of `box`. Empty if the box is outside the
/// picture.
[[nodiscard]] PixelRect pixelsAround(const Eigen::AlignedBox2d& box, int margin, Size picture);

}  // namespace mfar
