#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/lens_rays.h"
#include "pipeline/render/path_integrator.h"
#include "pipeline/render/render_view.h"

#include <memory>
#include <span>
#include <utility>

namespace mfar {

/// Rays of a view's pixels in the world.
class ViewRays {
public:
    /// `lens` must belong to the view's camera.
    ViewRays(const RenderView& view, std::shared_ptr<const LensRays> lens)
        : lens_(std::move(lens)),
          rotation_(view.T_world_camera.rotation.normalized().toRotationMatrix().cast<float>()),
          eye_(view.T_world_camera.translation.cast<float>()),
          focal_(static_cast<float>(view.camera.fx)) {}

    /// The direction has z = 1 in the camera's frame, so that RayHit::t of a hit is its depth.
    [[nodiscard]] Ray at(const Eigen::Vector2f& pixel) const {
        return {eye_, rotation_ * lens_->at(pixel.x(), pixel.y()).homogeneous()};
    }
    [[nodiscard]] const Eigen::Vector3f& eye() const { return eye_; }
    /// Width [m] of a pixel at this depth [m], on a plane that faces the camera.
    [[nodiscard]] float pixelWidth(float depth) const { return depth / focal_; }

private:
    std::shared_ptr<const LensRays> lens_;
    Eigen::Matrix3f rotation_;
    Eigen::Vector3f eye_;
    float focal_;
};

/// A position relative to a pixel's centre [px].
struct PixelOffset {
    float x, y;
};

/// Computes the surface of an object that a pixel shows, and the distant light on it. On curved
/// surfaces and on surfaces with relief, normal and light are means over several points of the
/// pixel, because a single point would give noisy light.
class PixelSurfaces {
public:
    /// The arguments must outlive this object.
    PixelSurfaces(const TracedScene& scene, const PathIntegrator& integrator, const ViewRays& rays)
        : scene_(scene), integrator_(integrator), rays_(rays) {}

    /// `ray` is the ray through the centre of `pixel`, and `hit` is its hit on an object.
    [[nodiscard]] SeenSurface at(const Eigen::Vector2f& pixel, const Ray& ray,
                                 const RayHit& hit) const;

private:
    class Mean;
    /// Adds those points at the given offsets that are on the object `id`.
    void add(const Eigen::Vector2f& pixel, std::span<const PixelOffset> offsets, std::uint8_t id,
             Mean& mean) const;

    const TracedScene& scene_;
    const PathIntegrator& integrator_;
    const ViewRays& rays_;
};

}  // namespace mfar
