#pragma once

#include "base/geometry.h"
#include "tests/measure/triangulation/triangulation.h"

namespace mfar {

/// Rounds to multiples of 2^-12, as SplitVector::head needs.
inline Eigen::Vector2f onGrid(const Eigen::Vector2f& v) {
    constexpr float kGrid = 4096;
    return ((v * kGrid).array() + 0.5F).floor() / kGrid;
}

/// Returns w with distort(r + w) - distort(r) = g: the change of the ray `r` that belongs to a
/// displacement `g` of up to a pixel on the sensor [normalised units]. Uses Newton's method
/// with the Jacobian at `r`. The difference is computed term by term to avoid cancellation. Returns
/// 0 where the lens model is not invertible.
SplitVector undistortStep(const CameraModel& camera, const Eigen::Vector2f& r,
                          const Eigen::Vector2f& g);

}  // namespace mfar
