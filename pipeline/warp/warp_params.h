#pragma once

#include "base/geometry.h"
#include "pipeline/composite/pass_values.h"
#include "pipeline/warp/pass_params.h"

#include <Eigen/Geometry>

namespace mfar {

/// Rectangle around the pixels of a picture that are within `margin` px of a box. Empty if the box
/// is outside the picture.
[[nodiscard]] PixelRect pixelsAround(const Eigen::AlignedBox2d& box, int margin, Size picture);

}  // namespace mfar
