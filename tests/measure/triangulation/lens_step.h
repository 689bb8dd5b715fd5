#pragma once

#include "base/geometry.h"
#include "tests/measure/triangulation/triangulation.h"

namespace mfar {

/// The nearest point on the grid of the heads of SplitVector.
inline Eigen::Vector2f onGrid(const Eigen::Vector2f& v) {
    constexpr float kGrid = 4096;
    return ((v * kGrid).array() + 0.5F).floor() / kGrid;
}

/// Undistorts a step `g` [normalised units] of up to a pixel on the sensor, taken from the ray `r`:
/// finds w with distort(r + w) - distort(r) = g by Newton steps with the Jacobian at the ray. The
/// difference is computed term by term to avoid cancellation. Zero where the lens model folds over.
SplitVector undistortStep(const CameraModel& camera, const Eigen::Vector2f& r,
                          const Eigen::Vector2f& g);

}  // namespace mfar
