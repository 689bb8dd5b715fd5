#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/lens_rays.h"
#include "pipeline/render/render_view.h"

#include <Eigen/Geometry>

#include <memory>

namespace mfar {

/// Light that an earlier picture found on surfaces that another view sees, too. Calls may run at
/// the same time; the film must not change meanwhile and must outlive this object.
class LightHistory {
public:
    /// `mostSamples`: upper limit of the weight of a point's light, in samples. `lens`: of the
    /// view.
    LightHistory(const Film& film, const RenderView& view, std::shared_ptr<const LensRays> lens,
                 float mostSamples);

    /// Light of the surface at `point` in the world, seen from `eye`: interpolated between the
    /// pixels that show the same surface there. The weight of specular light falls as its lobe
    /// turns. Empty if no pixel shows the surface.
    [[nodiscard]] KnownLight at(const SeenSurface& seen, const Eigen::Vector3f& point,
                                const Eigen::Vector3f& eye) const;

private:
    [[nodiscard]] bool isSame(std::size_t pixel, const Eigen::Vector2f& ray,
                              const SeenSurface& seen, const Eigen::Vector3f& point) const;

    const Film& film_;
    CameraModel camera_;
    std::shared_ptr<const LensRays> lens_;
    Eigen::Matrix3f rotation_;  // camera to world
    Eigen::Vector3f eye_;
    float mostSamples_;
};

}  // namespace mfar
