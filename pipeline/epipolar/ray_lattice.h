#pragma once

#include "base/geometry.h"

#include <vector>

namespace mfar {

/// An offset in whole pixels.
struct PixelOffset {
    int x = 0, y = 0;
};

[[nodiscard]] bool isSame(const CameraModel& a, const CameraModel& b);

/// Rays of every kStep-th pixel of a camera, also outside its picture; each is computed when it is
/// first requested. Cameras that differ only in size and by whole steps of their principal point
/// share a lattice.
class RayLattice {
public:
    static constexpr int kStep = 8;  ///< [px]

    /// Points [x0, x1) x [y0, y1) of the lattice, in steps of the camera's pixels. Valid until the
    /// next call. A ray that the lens does not show is NaN.
    struct Part {
        const float *x, *y;  ///< of point (x0, y0)
        int pitch;           ///< from one row to the next [floats]
    };
    [[nodiscard]] Part part(const CameraModel& camera, const PixelRect& points);

private:
    void cover(const PixelRect& points);

    CameraModel camera_;  // with its principal point within the first step
    PixelRect known_;
    std::vector<float> x_, y_;
};

}  // namespace mfar
