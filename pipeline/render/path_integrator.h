#pragma once

#include "pipeline/render/environment_light.h"
#include "pipeline/render/far_light.h"
#include "pipeline/render/paint.h"
#include "pipeline/render/path_tracer_options.h"
#include "pipeline/render/sobol.h"
#include "pipeline/render/sun_light.h"
#include "pipeline/render/traced_scene.h"

namespace mfar {

/// Number of random pairs that a sample uses before its path begins: one, for the position in the
/// pixel.
inline constexpr std::uint32_t kCameraPairs = 1;

/// Computes the light that a path returns from the first surface that it hits.
class PathIntegrator {
public:
    /// Both arguments must outlive the integrator.
    PathIntegrator(const TracedScene& scene, const PathTracerOptions& options);

    /// Radiance that a point of an object sends towards the camera, the point's paint, and the
    /// light on the point. `direction` is the direction of the ray that hit the point, of any
    /// length.
    struct OfObject {
        Eigen::Vector3f radiance;
        SurfaceLight light, far;  ///< `far` is the result of far()
        Paint paint;
    };
    [[nodiscard]] OfObject ofObject(const RayHit& hit, const Eigen::Vector3f& direction,
                                    const PixelSampler& sampler) const;

    /// Light that a point of an object would receive if nothing blocked it; always above 0.
    [[nodiscard]] SurfaceLight far(const SurfacePoint& point,
                                   const Eigen::Vector3f& direction) const;

    /// The distant light that the surfaces of pictures mirror.
    [[nodiscard]] MirrorLight mirrorLight() const;

    /// Radiance of the shadow catcher with and without the objects, computed from the same random
    /// numbers. Both are bit-identical if the path did not hit an object.
    struct OfCatcher {
        Eigen::Vector3f with, without;
    };
    [[nodiscard]] OfCatcher ofCatcher(const RayHit& hit, const Eigen::Vector3f& direction,
                                      const PixelSampler& sampler) const;

private:
    struct World;
    struct Vertex;
    struct Carried;
    /// Radiance that leaves the first point of a path, and its diffuse part divided by the point's
    /// paint.
    struct Sent {
        Eigen::Vector3f radiance{0, 0, 0}, white{0, 0, 0};

        Sent& operator+=(const Sent& other) {
            radiance += other.radiance;
            white += other.white;
            return *this;
        }
    };
    /// Light that arrives directly from the lights. `light` is the light that no object blocks.
    /// `unblocked` is the light of the known lights as it would be without objects. A wide sun is
    /// not a known light.
    struct Arrived {
        Sent light, unblocked;
    };
    /// The parts of the light that some lobes of the first surface send to the eye.
    struct Parts {
        Arrived direct;  ///< light that comes directly from the lights
        Sent known;      ///< mean of direct.unblocked, approximated without a ray
        Sent rest;       ///< light that comes via other surfaces
    };
    /// Light that `point` sends towards `wo` through these lobes.
    [[nodiscard]] Parts walk(SurfacePoint point, Eigen::Vector3f wo, Lobes lobes,
                             const PixelSampler& sampler, World& world) const;
    /// Sums the parts for sample `number` of a pixel.
    [[nodiscard]] static Sent sum(const Parts& parts, std::uint32_t number);
    [[nodiscard]] Arrived direct(const Vertex& vertex, Lobes lobes, const PixelSampler& sampler,
                                 std::uint32_t pair, World& world) const;
    /// Weight of a sample in multiple importance sampling. `taken` is the density of the strategy
    /// that drew the sample, `other` that of the other strategy.
    using Weight = float (*)(float taken, float other);
    /// `far` is FarLight's radiance in the sample's direction.
    [[nodiscard]] static Arrived lit(const Vertex& vertex, Lobes lobes, const LightSample& light,
                                     const Eigen::Vector3f& far, Weight weight, World& world);
    /// Light from a direction in which a ray hits no surface. `light` is the true light, and `far`
    /// is FarLight's radiance.
    struct Escaped {
        Eigen::Vector3f light{0, 0, 0}, far{0, 0, 0};
    };
    /// Direct light as it would be without objects, computed without a ray.
    [[nodiscard]] Sent known(const Vertex& vertex, const Eigen::Vector3f& wo, Lobes lobes,
                             bool withSun) const;
    [[nodiscard]] Sent knownSky(const Vertex& vertex, const Eigen::Vector3f& wo, Lobes lobes) const;
    /// Computed as for a narrow sun: the wider the sun, the larger the error.
    [[nodiscard]] Sent knownSun(const Vertex& vertex, const Eigen::Vector3f& wo, Lobes lobes) const;
    [[nodiscard]] Escaped escaped(const Eigen::Vector3f& direction, float density) const;
    /// Factor (at most 1) that limits `light` to the firefly clamp. Light is limited if it comes
    /// from the second surface of the path or later ones; `depth` is the number of the surface.
    [[nodiscard]] float kept(const Eigen::Vector3f& light, int depth) const;
    /// `light` multiplied with the carried reflectances and limited by kept().
    [[nodiscard]] Sent sent(const Carried& carried, const Eigen::Vector3f& light, int depth) const;

    const TracedScene& scene_;
    const PathTracerOptions& options_;
    SunLight sun_;
    bool sunIsKnown_;
    EnvironmentLight environment_;
    FarLight far_;
    float leastFar_;  // above 0, because light is divided by far light
};

}  // namespace mfar
