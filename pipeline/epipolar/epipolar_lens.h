#pragma once

#include "base/geometry.h"
#include "pipeline/simd/lens.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace mfar {

/// Returns the largest radius of the rays (x/z, y/z) through the picture's corners.
[[nodiscard]] double cornerRadius(const CameraModel& camera);

/// Beyond a certain radius, a lens model can fold rays (x/z, y/z) back towards the centre. Returns
/// this radius, but at least `picture`, the radius of the picture's corners, and at most `beyond`
/// times `picture`.
[[nodiscard]] double rimOf(const CameraModel& camera, double picture, double beyond);

/// The rays of a camera's pixels at one pyramid level, and the motion of their points when the
/// camera is translated. Copies of this object share the table of rays.
///
/// The unknown is s [1/unit of length], the inverse depth of a point in a second view with the same
/// orientation. The first view sees the point at ray r = (x, y) and depth Z. Adding t to the
/// point's coordinates in the first view gives those in the second view. The second view sees the
/// point at the ray r + s (t.xy - r t.z) with s = 1 / (Z + t.z).
/// This is linear in s, so equal steps of s are equal steps on the epipolar line. The inverse depth
/// in the first view is s / (1 - s t.z). Source: Hartley and Zisserman, 9.5.
class EpipolarLens {
public:
    /// `camera` is the camera at full size. Its picture is halved `level` times. Each time, width
    /// and height are rounded up.
    EpipolarLens(const CameraModel& camera, int level);

    /// Makes this object the lens of the rectangle `pixels`, a part of the picture of `whole`.
    void cover(const EpipolarLens& whole, const PixelRect& pixels);

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] float rayX(std::size_t pixel) const { return rays_->x[pixel]; }
    [[nodiscard]] float rayY(std::size_t pixel) const { return rays_->y[pixel]; }
    [[nodiscard]] const std::vector<float>& raysX() const { return rays_->x; }
    [[nodiscard]] const std::vector<float>& raysY() const { return rays_->y; }
    [[nodiscard]] const simd::Lens& lens() const { return lens_; }

    struct Point {
        float x, y;
    };
    /// Maps a ray (x / z, y / z) to a pixel of this level, with distortion. A ray outside the valid
    /// radius is first moved to this radius, so that distortion never folds it back.
    [[nodiscard]] Point project(float x, float y) const {
        // Has no branch, so that the compiler can vectorise loops over pixels.
        const float r2 = x * x + y * y;
        const float c = std::sqrt(lens_.rim2 / std::max(r2, lens_.rim2));
        x *= c;
        y *= c;
        const float q = std::min(r2, lens_.rim2);
        const float radial = 1 + q * (lens_.k1 + q * (lens_.k2 + q * lens_.k3));
        const float xy = 2 * x * y;
        return {lens_.fx * (x * radial + lens_.p1 * xy + lens_.p2 * (q + 2 * x * x)) + lens_.cx,
                lens_.fy * (y * radial + lens_.p2 * xy + lens_.p1 * (q + 2 * y * y)) + lens_.cy};
    }

    /// Returns the row-major index of the pixel that contains the point, or -1 outside the picture.
    [[nodiscard]] int pixelAt(Point p) const {
        // Rounds by adding 0.5 and truncating, because the oldest supported x86 CPUs cannot round
        // in one instruction.
        const float u = p.x + 0.5F, v = p.y + 0.5F;
        const bool inside = u >= 0 && v >= 0 && u < static_cast<float>(size_.width) &&
                            v < static_cast<float>(size_.height);
        return inside ? static_cast<int>(v) * size_.width + static_cast<int>(u) : -1;
    }

private:
    struct Rays {
        std::vector<float> x, y;
    };

    Size size_;
    simd::Lens lens_;
    std::shared_ptr<Rays> rays_;  // may be written only while no copy shares it
};

}  // namespace mfar
