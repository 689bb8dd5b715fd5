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

/// Largest radius of a ray that the lens's radial distortion does not fold back, searched from
/// `picture`, the radius of the picture's corners, to `beyond` times that radius.
[[nodiscard]] double rimOf(const CameraModel& camera, double picture, double beyond);

/// The rays of a camera's pixels at one pyramid level, and where a translation moves them. Copies
/// share the table of the rays.
///
/// The state is s [1/unit of length], the inverse depth seen from the second view. A point at ray
/// r = (x, y) with depth Z is seen by a camera of the same orientation whose motion moves points
/// by t. There it lies at r + s (t.xy - r t.z) with s = 1 / (Z + t.z). This is linear in s, so
/// equal steps of s are equal steps on the epipolar line. The inverse depth in the first view is
/// rho = s / (1 - s t.z) (Hartley and Zisserman, 9.5).
class EpipolarLens {
public:
    /// `camera`: the camera of the finest level; `level`: number of halvings, each of which rounds
    /// the size up.
    EpipolarLens(const CameraModel& camera, int level);

    /// Becomes a lens for these pixels of `whole` only.
    void cover(const EpipolarLens& whole, const PixelRect& pixels);

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] float rayX(std::size_t pixel) const { return rays_->x[pixel]; }
    [[nodiscard]] float rayY(std::size_t pixel) const { return rays_->y[pixel]; }
    /// The rays of all pixels, row-major.
    [[nodiscard]] const std::vector<float>& raysX() const { return rays_->x; }
    [[nodiscard]] const std::vector<float>& raysY() const { return rays_->y; }
    /// For kernels.
    [[nodiscard]] const simd::Lens& lens() const { return lens_; }

    struct Point {
        float x, y;
    };
    /// Ray (x / z, y / z) to pixel of this level, with the lens's distortion. Rays beyond the
    /// lens's rim are moved to the rim, so that distortion never folds them back.
    [[nodiscard]] Point project(float x, float y) const {
        // No branch, so that the compiler vectorizes loops over pixels.
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

    /// Row-major index of the pixel that contains a point; -1 outside the picture.
    [[nodiscard]] int pixelAt(Point p) const {
        // Truncates, because the oldest x86 has no rounding instruction.
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
    std::shared_ptr<Rays> rays_;  // written only while it is not shared
};

}  // namespace mfar
