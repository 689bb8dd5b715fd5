#pragma once

#include "base/geometry.h"

#include <vector>

namespace mfar {

struct PixelOffset {
    int x = 0, y = 0;
};

/// Rays of every kStep-th pixel of a camera, also outside its picture. They are computed when first
/// requested, and stored. They are used again for a camera that differs only in size, or whose
/// principal point differs by whole steps.
class RayLattice {
public:
    static constexpr int kStep = 8;

    /// The rays of the points [x0, x1) x [y0, y1) of the lattice; coordinates are counted in steps.
    /// They are valid until the next call of part(). A ray is NaN if the lens maps no ray to its
    /// pixel.
    struct Part {
        const float *x, *y;
        int pitch;
    };
    [[nodiscard]] Part part(const CameraModel& camera, const PixelRect& points);

private:
    void cover(const PixelRect& points);

    // The camera whose rays are stored. Its principal point is moved by whole steps into [0,
    // kStep), and its size is set to 0x0.
    CameraModel camera_;
    PixelRect known_;
    std::vector<float> x_, y_;
};

}  // namespace mfar
