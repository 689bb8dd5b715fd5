#pragma once

#include "base/geometry.h"
#include "tests/measure/triangulation/triangulation.h"

namespace mfar {

/// Nearest point of the grid of SplitVector's heads.
inline Eigen::Vector2f onGrid(const Eigen::Vector2f& v) {
    constexpr float kGrid = 4096;
    return ((v * kGrid).array() + 0.5F).floor() / kGrid;
}

/// Undistorts a step `g` on the sensor of up to a pixel [normalised units] from the ray `r`: solves
/// distort(r + w) - distort(r) = g for w by Newton steps with the Jacobian at the ray. The
/// difference is computed term by term to avoid cancellation. Zero where the lens model folds over.
SplitVector undistortStep(const CameraModel& camera, const Eigen::Vector2f& r,
                          const Eigen::Vector2f& g);

}  // namespace mfar
