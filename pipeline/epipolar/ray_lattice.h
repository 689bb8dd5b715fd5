#pragma once

#include "base/geometry.h"

#include <vector>

namespace mfar {

struct PixelOffset {
    int x = 0, y = 0;
};

[[nodiscard]] bool isSame(const CameraModel& a, const CameraModel& b);

/// Rays of every kStep-th pixel of a camera, also outside its picture. They are computed at the
/// first request and stored. A camera that differs only in size, and in its principal point by
/// whole steps, uses the same rays.
class RayLattice {
public:
    static constexpr int kStep = 8;

    /// The rays of points [x0, x1) x [y0, y1) of the lattice, counted in steps. Valid until the
    /// next call of part(). A ray is NaN if the lens maps no ray to its pixel.
    struct Part {
        const float *x, *y;
        int pitch;
    };
    [[nodiscard]] Part part(const CameraModel& camera, const PixelRect& points);

private:
    void cover(const PixelRect& points);

    // The camera of the stored rays, moved by whole steps, so that its principal point is in
    // [0, kStep). Its size is always 0x0.
    CameraModel camera_;
    PixelRect known_;
    std::vector<float> x_, y_;
};

}  // namespace mfar
