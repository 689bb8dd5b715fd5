#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/lens_rays.h"
#include "pipeline/render/moved_light.h"
#include "pipeline/render/render_view.h"

#include <Eigen/Geometry>

#include <memory>
#include <optional>

namespace mfar {

/// Looks up light that an earlier picture measured on the surfaces that a new view shows. Threads
/// may call it at the same time. The film of the earlier picture must not change meanwhile, and
/// must outlive this object.
class LightHistory {
public:
    /// `film` and `view` belong to the earlier picture, `lens` to `view`. `mostSamples` limits the
    /// weight of the light at a point [samples]. `moved` describes the motion of objects since the
    /// earlier picture.
    LightHistory(const Film& film, const RenderView& view, std::shared_ptr<const LensRays> lens,
                 float mostSamples, std::optional<MovedLight> moved = {});

    /// Returns the light of the surface at `point` (world frame), seen from `eye`. It interpolates
    /// between those pixels of the earlier picture that show this surface. The weight of specular
    /// light falls with the angle between the two viewing directions. The weight of all light,
    /// except the shadow catcher's light without objects, falls with the change that moved objects
    /// may have caused. If no pixel shows the surface, the result has no samples.
    [[nodiscard]] KnownLight at(const SeenSurface& seen, const Eigen::Vector3f& point,
                                const Eigen::Vector3f& eye) const;
    /// Makes at() return no light for the shadow catcher. To be called if the lighting has changed:
    /// the catcher's light is a radiance, but an object's light is a multiple of the distant light
    /// (see KnownLight).
    void forgetCatcher() { knowsCatcher_ = false; }
    /// Null if the constructor got no `moved`.
    [[nodiscard]] const MovedLight* moved() const { return moved_ ? &*moved_ : nullptr; }

private:
    [[nodiscard]] KnownLight found(const SeenSurface& seen, const Eigen::Vector3f& point,
                                   const Eigen::Vector3f& eye) const;
    [[nodiscard]] bool isSparseAt(const Eigen::Vector2d& pixel) const;
    [[nodiscard]] KnownLight between(const Eigen::Vector2d& pixel, int step,
                                     const SeenSurface& seen, const Eigen::Vector3f& point) const;
    [[nodiscard]] bool isSame(std::size_t pixel, const Eigen::Vector2f& ray,
                              const SeenSurface& seen, const Eigen::Vector3f& point) const;

    const Film& film_;
    CameraModel camera_;
    std::shared_ptr<const LensRays> lens_;
    Eigen::Matrix3f rotation_;
    Eigen::Vector3f eye_;
    float mostSamples_;
    std::optional<MovedLight> moved_;
    bool knowsCatcher_ = true;
};

}  // namespace mfar
