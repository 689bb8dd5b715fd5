#pragma once

#include "base/geometry.h"
#include "tests/measure/triangulation/triangulation.h"

namespace mfar {

/// Nearest point of the grid of heads.
inline Eigen::Vector2f onGrid(const Eigen::Vector2f& v) {
    constexpr float kGrid = 4096;
    return ((v * kGrid).array() + 0.5F).floor() / kGrid;
}

/// A step `g` of up to a pixel on the sensor [normalised units], beside the ray `r`, without the
/// distortion: solves distort(r + w) - distort(r) = g for w by Newton steps with the Jacobian at
/// the ray; the difference is taken term by term, so that nothing cancels. Zero where the lens
/// model folds over.
SplitVector undistortStep(const CameraModel& camera, const Eigen::Vector2f& r,
                          const Eigen::Vector2f& g);

}  // namespace mfar
