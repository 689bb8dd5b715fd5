#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/lens_rays.h"
#include "pipeline/render/render_view.h"

#include <Eigen/Geometry>

#include <memory>

namespace mfar {

/// Finds light that an earlier picture measured on surfaces that are also visible in another view.
/// Threads may call it at the same time. The film must not change meanwhile and must outlive this
/// object.
class LightHistory {
public:
    /// `mostSamples` is the upper limit of a point's weight [samples]. `lens` belongs to `view`.
    LightHistory(const Film& film, const RenderView& view, std::shared_ptr<const LensRays> lens,
                 float mostSamples);

    /// Light of the surface at `point` (in the world) seen from `eye`, interpolated between the
    /// pixels of the earlier picture that show the same surface. The weight of specular light falls
    /// with the angle between the two directions of view. Empty if no pixel shows the surface.
    [[nodiscard]] KnownLight at(const SeenSurface& seen, const Eigen::Vector3f& point,
                                const Eigen::Vector3f& eye) const;

private:
    [[nodiscard]] bool isSparseAt(const Eigen::Vector2d& pixel) const;
    [[nodiscard]] KnownLight between(const Eigen::Vector2d& pixel, int step,
                                     const SeenSurface& seen, const Eigen::Vector3f& point) const;
    [[nodiscard]] bool isSame(std::size_t pixel, const Eigen::Vector2f& ray,
                              const SeenSurface& seen, const Eigen::Vector3f& point) const;

    const Film& film_;
    CameraModel camera_;
    std::shared_ptr<const LensRays> lens_;
    Eigen::Matrix3f rotation_;  // from camera to world
    Eigen::Vector3f eye_;
    float mostSamples_;
};

}  // namespace mfar
