#pragma once

#include "pipeline/render/environment_light.h"
#include "pipeline/render/far_light.h"
#include "pipeline/render/paint.h"
#include "pipeline/render/path_tracer_options.h"
#include "pipeline/render/sobol.h"
#include "pipeline/render/sun_light.h"
#include "pipeline/render/traced_scene.h"

namespace mfar {

/// Pairs of random numbers that a sample uses before its path: for the place in the pixel.
inline constexpr std::uint32_t kCameraPairs = 1;

/// Computes the light that a path brings back from the surface that it meets first.
class PathIntegrator {
public:
    /// Both arguments must outlive the integrator.
    PathIntegrator(const TracedScene& scene, const PathTracerOptions& options);

    /// Radiance that an object's point sends against `direction` (of any length), the direction of
    /// the ray that hit it; also the point's paint and the light on it.
    struct OfObject {
        Eigen::Vector3f radiance;
        SurfaceLight light, far;  ///< `far`: see far()
        Paint paint;
    };
    [[nodiscard]] OfObject ofObject(const RayHit& hit, const Eigen::Vector3f& direction,
                                    const PixelSampler& sampler) const;

    /// Light on a point of an object if nothing blocked it, above 0.
    [[nodiscard]] SurfaceLight far(const SurfacePoint& point,
                                   const Eigen::Vector3f& direction) const;

    /// Distant light for the surfaces of pictures.
    [[nodiscard]] MirrorLight mirrorLight() const;

    /// Radiance of the catcher with and without the objects, from the same random numbers:
    /// bit-identical if no object was met.
    struct OfCatcher {
        Eigen::Vector3f with, without;
    };
    [[nodiscard]] OfCatcher ofCatcher(const RayHit& hit, const Eigen::Vector3f& direction,
                                      const PixelSampler& sampler) const;

private:
    struct World;
    struct Vertex;
    struct Carried;
    /// Radiance that leaves the first point of a path, and its diffuse part before the point's
    /// paint.
    struct Sent {
        Eigen::Vector3f radiance{0, 0, 0}, white{0, 0, 0};

        Sent& operator+=(const Sent& other) {
            radiance += other.radiance;
            white += other.white;
            return *this;
        }
    };
    /// Light directly from the lights: as the objects let it through, and that of the known lights
    /// as it would be without objects. A wide sun is not a known light.
    struct Arrived {
        Sent light, unblocked;
    };
    /// Light that some lobes of the first surface send to the eye, in parts.
    struct Parts {
        Arrived direct;  ///< directly from the lights
        Sent known;      ///< approximate mean of direct.unblocked, without a ray
        Sent rest;       ///< via other surfaces
    };
    /// Light from `point` to `wo`, by these lobes.
    [[nodiscard]] Parts walk(SurfacePoint point, Eigen::Vector3f wo, Lobes lobes,
                             const PixelSampler& sampler, World& world) const;
    /// Total for sample `number` of a pixel.
    [[nodiscard]] static Sent sum(const Parts& parts, std::uint32_t number);
    [[nodiscard]] Arrived direct(const Vertex& vertex, Lobes lobes, const PixelSampler& sampler,
                                 std::uint32_t pair, World& world) const;
    /// Weight of one strategy's sample, from its density and the other strategy's.
    using Weight = float (*)(float taken, float other);
    /// `far`: FarLight's radiance in the sample's direction.
    [[nodiscard]] static Arrived lit(const Vertex& vertex, Lobes lobes, const LightSample& light,
                                     const Eigen::Vector3f& far, Weight weight, World& world);
    /// Light from a direction in which no surface is: the light itself, and FarLight's.
    struct Escaped {
        Eigen::Vector3f light{0, 0, 0}, far{0, 0, 0};
    };
    /// Light without objects, computed without a ray.
    [[nodiscard]] Sent known(const Vertex& vertex, const Eigen::Vector3f& wo, Lobes lobes,
                             bool withSun) const;
    [[nodiscard]] Sent knownSky(const Vertex& vertex, const Eigen::Vector3f& wo, Lobes lobes) const;
    /// Computed for a narrow sun: the wider the sun, the larger the error.
    [[nodiscard]] Sent knownSun(const Vertex& vertex, const Eigen::Vector3f& wo, Lobes lobes) const;
    [[nodiscard]] Escaped escaped(const Eigen::Vector3f& direction, float density) const;
    /// Factor that limits light from surface number `depth` of a path to the firefly clamp.
    [[nodiscard]] float kept(const Eigen::Vector3f& light, int depth) const;
    /// That light as the path carries it, limited by kept().
    [[nodiscard]] Sent sent(const Carried& carried, const Eigen::Vector3f& light, int depth) const;

    const TracedScene& scene_;
    const PathTracerOptions& options_;
    SunLight sun_;
    bool sunIsKnown_;
    EnvironmentLight environment_;
    FarLight far_;
    float leastFar_;  // lower limit, because light is divided by it
};

}  // namespace mfar
