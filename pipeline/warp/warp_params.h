#pragma once

#include "base/geometry.h"
#include "pipeline/composite/lens_projection.h"

#include <Eigen/Geometry>

namespace mfar {

/// Rows of the matrix of T, which scales first, for a std140 block.
void storeRows(float (&rows)[3][4], const RigidTransform& T, double scale = 1);

/// A camera for a std140 block: pinhole = fx, fy, cx, cy [px]; distortion = k1, k2, p1, p2; lens =
/// k3, radius of the rim, radial factor there, near plane [m].
void storeLens(float (&pinhole)[4], float (&distortion)[4], float (&lens)[4],
               const LensProjection& projection);

/// Pixels of a picture within `margin` px of a box; not of a picture beside it.
[[nodiscard]] PixelRect pixelsAround(const Eigen::AlignedBox2d& box, int margin, Size picture);

}  // namespace mfar
