#pragma once

#include "pipeline/render/emissive_triangles.h"
#include "pipeline/render/environment_light.h"
#include "pipeline/render/far_light.h"
#include "pipeline/render/paint.h"
#include "pipeline/render/path_tracer_options.h"
#include "pipeline/render/sobol.h"
#include "pipeline/render/sun_light.h"
#include "pipeline/render/traced_scene.h"

#include <memory>
#include <optional>

namespace mfar {

/// Number of pairs of random numbers that a sample uses before its path begins.
inline constexpr std::uint32_t kCameraPairs = 1;

/// The distant light of a scene, which does not depend on the poses of objects.
struct DistantLight {
    explicit DistantLight(const Scene& scene)
        : sun(scene.lighting.sun), environment(scene.lighting.environment),
          far(environment, scene.lighting, scene.catcher) {}
    DistantLight(const DistantLight&) = delete;
    DistantLight& operator=(const DistantLight&) = delete;

    SunLight sun;
    EnvironmentLight environment;
    FarLight far;
};

/// Computes the light that the first surface on a camera ray sends to the camera. Follows paths
/// from there to other surfaces and to the lights.
class PathIntegrator {
public:
    /// `scene` and `options` must outlive the integrator. `light` must belong to the scene.
    PathIntegrator(const TracedScene& scene, const PathTracerOptions& options,
                   std::shared_ptr<const DistantLight> light);
    /// For the same scene with objects in other poses.
    PathIntegrator(const PathIntegrator& other, const TracedScene& posed,
                   const PathTracerOptions& options);

    /// Radiance from a point of an object towards the camera, the point's paint, and the light on
    /// the point.
    struct OfObject {
        Eigen::Vector3f radiance;
        SurfaceLight light, far;
        Paint paint;
    };
    [[nodiscard]] OfObject ofObject(const RayHit& hit, const Eigen::Vector3f& direction,
                                    const PixelSampler& sampler) const;

    /// Light that a point of an object would receive if nothing blocked it; always above 0.
    /// `direction` is the ray's direction; it may have any length.
    [[nodiscard]] SurfaceLight far(const SurfacePoint& point,
                                   const Eigen::Vector3f& direction) const;

    /// Mean brightness of the distant light without the sun.
    [[nodiscard]] float farBrightness() const { return far_.brightness(); }

    [[nodiscard]] MirrorLight mirrorLight() const;

    /// Radiance of the shadow catcher with objects and without them, computed from the same random
    /// numbers. Both are bit-identical if the path did not hit an object.
    struct OfCatcher {
        Eigen::Vector3f with, without;
    };
    [[nodiscard]] OfCatcher ofCatcher(const RayHit& hit, const Eigen::Vector3f& direction,
                                      const PixelSampler& sampler) const;

private:
    PathIntegrator(const TracedScene& scene, const PathTracerOptions& options,
                   std::shared_ptr<const DistantLight> light, EmissiveTriangles emitters);

    struct World;
    struct Vertex;
    struct Carried;
    struct Lights;
    struct Walk;
    /// Radiance that leaves the first point of a path. `white` is its diffuse part divided by the
    /// point's paint.
    struct Sent {
        Eigen::Vector3f radiance{0, 0, 0}, white{0, 0, 0};

        Sent& operator+=(const Sent& other) {
            radiance += other.radiance;
            white += other.white;
            return *this;
        }
    };
    /// Light that comes directly from the lights. `unblocked` is the same light without objects in
    /// its way, and without a sun wider than kWidestKnownSun.
    struct Arrived {
        Sent light, unblocked;
    };
    struct Parts {
        Arrived direct;
        Sent rest;
    };
    /// Follows a path from the point `first`. `lights` are samples of the sun and the environment
    /// for this point.
    [[nodiscard]] Parts walk(const Vertex& first, Lobes lobes, Lights& lights,
                             const PixelSampler& sampler, World& world) const;
    /// Adds the light that the lights send to a walk's vertex, and the emission of the vertex
    /// itself.
    void addDirect(const Vertex& vertex, Lights& lights, Walk& walk) const;
    /// Follows a reflected ray from a walk's vertex, and adds the distant light at its end. Returns
    /// true if it reaches a surface, which is then `walk.reached`.
    [[nodiscard]] bool scatter(const Vertex& vertex, Walk& walk) const;
    /// Returns the share of the direct light that nothing blocks, or `otherwise` without light.
    [[nodiscard]] static float unblockedShare(const Arrived& direct, float otherwise);
    /// Returns the light of all parts. `number` is the index of the sample in its pixel. `known` is
    /// an approximation of parts.direct.unblocked that needs no ray. `open`: see unblockedShare().
    [[nodiscard]] static Sent sum(const Parts& parts, const Sent& known, float open,
                                  std::uint32_t number);
    /// Weight in multiple importance sampling. `taken` is the density of the strategy that
    /// generated the sample; `other` is the density of the other strategy for this sample.
    using Weight = float (*)(float taken, float other);
    /// A sample of the sun or the environment. `far` is FarLight's approximation of its radiance.
    struct SampledLight {
        LightSample light;
        Eigen::Vector3f far{0, 0, 0};
        Weight weight = nullptr;
        std::optional<bool> reaches;  ///< true: nothing blocks it; empty: not yet tested
    };
    [[nodiscard]] Lights sampledLights(const PixelSampler& sampler, std::uint32_t pair) const;
    [[nodiscard]] static Arrived direct(const Vertex& vertex, Lobes lobes, Lights& lights,
                                        World& world);
    [[nodiscard]] static Arrived lit(const Vertex& vertex, Lobes lobes, SampledLight& sampled,
                                     World& world);
    /// Samples a point on an emissive triangle, and returns its light.
    [[nodiscard]] Sent emitted(const Vertex& vertex, Lobes lobes, const PixelSampler& sampler,
                               std::uint32_t pair, World& world) const;
    /// Light from a direction in which a ray hits no surface. `far` is FarLight's approximation of
    /// `light`.
    struct Escaped {
        Eigen::Vector3f light{0, 0, 0}, far{0, 0, 0};
    };
    /// Approximates the direct light that would arrive if no object existed. Traces no ray.
    [[nodiscard]] Sent known(const Vertex& vertex, Lobes lobes, bool withSun) const;
    [[nodiscard]] SurfaceLight far(const Sent& known, const Paint& paint) const;
    [[nodiscard]] Sent knownSky(const Vertex& vertex, Lobes lobes) const;
    /// Approximates the light of the sun without a ray. Assumes a narrow sun; the error grows with
    /// the sun's width.
    [[nodiscard]] Sent knownSun(const Vertex& vertex, Lobes lobes) const;
    [[nodiscard]] Escaped escaped(const Eigen::Vector3f& direction, float density) const;
    /// Returns the factor (at most 1) that limits `light` to the firefly clamp. It is 1 for light
    /// on the first surface (`depth` 1).
    [[nodiscard]] float kept(const Eigen::Vector3f& light, int depth) const;
    /// Russian roulette: returns false if the path ends at random. The light of a path that
    /// survives is divided by its probability to survive.
    [[nodiscard]] bool survives(Carried& carried, int depth, const PixelSampler& sampler,
                                std::uint32_t pair) const;
    [[nodiscard]] Sent sent(const Carried& carried, const Eigen::Vector3f& light, int depth) const;

    const TracedScene& scene_;
    const PathTracerOptions& options_;
    const std::shared_ptr<const DistantLight> light_;
    const SunLight& sun_;
    bool sunIsKnown_;
    const EnvironmentLight& environment_;
    EmissiveTriangles emitters_;
    const FarLight& far_;
    float leastFar_;
};

}  // namespace mfar
