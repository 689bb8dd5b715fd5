#pragma once

#include "base/geometry.h"

#include <vector>

namespace mfar {

/// An offset in whole pixels.
struct PixelOffset {
    int x = 0, y = 0;
};

[[nodiscard]] bool isSame(const CameraModel& a, const CameraModel& b);

/// Rays of every kStep-th pixel of a camera, also outside its picture. Each ray is computed when it
/// is first requested. Cameras share a lattice if they differ only in size and in whole steps of
/// their principal point.
class RayLattice {
public:
    static constexpr int kStep = 8;  ///< [px]

    /// Points [x0, x1) x [y0, y1) of the lattice, counted in steps. Valid until the next call. A
    /// ray is NaN if the lens maps no ray to its pixel.
    struct Part {
        const float *x, *y;  ///< ray of point (x0, y0)
        int pitch;           ///< from one row to the next [floats]
    };
    [[nodiscard]] Part part(const CameraModel& camera, const PixelRect& points);

private:
    void cover(const PixelRect& points);

    CameraModel camera_;  // size 0x0, and the principal point is within the first step
    PixelRect known_;
    std::vector<float> x_, y_;
};

}  // namespace mfar
