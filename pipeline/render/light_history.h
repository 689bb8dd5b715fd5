#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/lens_rays.h"
#include "pipeline/render/render_view.h"

#include <Eigen/Geometry>

#include <memory>

namespace mfar {

/// What an earlier picture knows of the light on surfaces that another view sees, too. Calls may
/// run at the same time; the film must not change meanwhile, and outlive this.
class LightHistory {
public:
    /// A point's light counts like `mostSamples` at most. `lens`: the view's.
    LightHistory(const Film& film, const RenderView& view, std::shared_ptr<const LensRays> lens,
                 float mostSamples);

    /// Light of the surface at `point` in the world, which an eye at `eye` sees: interpolated
    /// between the pixels that show the same surface there. Specular light counts less the more its
    /// lobe has turned. Nothing where none of them does.
    [[nodiscard]] KnownLight at(const SeenSurface& seen, const Eigen::Vector3f& point,
                                const Eigen::Vector3f& eye) const;

private:
    [[nodiscard]] bool isSame(std::size_t pixel, const Eigen::Vector2f& ray,
                              const SeenSurface& seen, const Eigen::Vector3f& point) const;

    const Film& film_;
    CameraModel camera_;
    std::shared_ptr<const LensRays> lens_;
    Eigen::Matrix3f R_world_camera_;
    Eigen::Vector3f eye_;
    float mostSamples_;
};

}  // namespace mfar
