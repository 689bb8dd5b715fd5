#pragma once

#include "base/geometry.h"
#include "pipeline/simd/lens.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace mfar {

/// Largest radius of the rays (x/z, y/z) through the picture's corners.
[[nodiscard]] double cornerRadius(const CameraModel& camera);

/// Largest radius of a ray that the lens's radial distortion does not fold back, from `picture`,
/// that of the picture's corners, to `beyond` times as much.
[[nodiscard]] double rimOf(const CameraModel& camera, double picture, double beyond);

/// The rays of a camera's pixels at one pyramid level, and where a translation moves them. Copies
/// share the table of the rays.
///
/// The state is s [1/unit of length], the inverse depth seen from the second view: a point at ray
/// r = (x, y) with depth Z, seen from a camera of the same orientation that moved so that points
/// move by t, lies at r + s (t.xy - r t.z) with s = 1 / (Z + t.z). It is linear in s, so equal
/// steps of s are equal steps on the epipolar line; rho = s / (1 - s t.z) (Hartley and
/// Zisserman, 9.5).
class EpipolarLens {
public:
    /// `camera` of the finest level, `level` halvings; size is halved and rounded up each time.
    EpipolarLens(const CameraModel& camera, int level);

    /// Becomes a lens over these pixels of `whole` alone.
    void cover(const EpipolarLens& whole, const PixelRect& pixels);

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] float rayX(std::size_t pixel) const { return rays_->x[pixel]; }
    [[nodiscard]] float rayY(std::size_t pixel) const { return rays_->y[pixel]; }
    /// Of all pixels, row-major.
    [[nodiscard]] const std::vector<float>& raysX() const { return rays_->x; }
    [[nodiscard]] const std::vector<float>& raysY() const { return rays_->y; }
    /// For kernels.
    [[nodiscard]] const simd::Lens& lens() const { return lens_; }

    struct Point {
        float x, y;
    };
    /// Ray (x / z, y / z) to pixel of this level, with the lens's distortion. Rays beyond what the
    /// lens can show are held at its rim, so that distortion never folds them back.
    [[nodiscard]] Point project(float x, float y) const {
        // No branch, so that loops over pixels become vectors.
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

    /// The pixel that holds a point, row-major; -1 outside of the picture.
    [[nodiscard]] int pixelAt(Point p) const {
        // Truncation, as there is no rounding instruction on the oldest x86.
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
    std::shared_ptr<Rays> rays_;  // written only while nobody shares it
};

}  // namespace mfar
