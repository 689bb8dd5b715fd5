#pragma once

#include "base/geometry.h"
#include "pipeline/composite/pass_values.h"
#include "pipeline/warp/pass_params.h"

#include <Eigen/Geometry>

namespace mfar {

/// Rectangle around those pixels of a picture that are within `margin` px of `box`. Empty if there
/// are none.
[[nodiscard]] PixelRect pixelsAround(const Eigen::AlignedBox2d& box, int margin, Size picture);

}  // namespace mfar
