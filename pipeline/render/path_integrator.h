#pragma once

#include "pipeline/render/environment_light.h"
#include "pipeline/render/far_light.h"
#include "pipeline/render/paint.h"
#include "pipeline/render/path_tracer_options.h"
#include "pipeline/render/sobol.h"
#include "pipeline/render/sun_light.h"
#include "pipeline/render/traced_scene.h"

namespace mfar {

/// Pairs of random numbers that a sample uses before its path: the place in the pixel.
inline constexpr std::uint32_t kCameraPairs = 1;

/// Light that a path brings back from where it first meets a surface.
class PathIntegrator {
public:
    /// What outlives the integrator.
    PathIntegrator(const TracedScene& scene, const PathTracerOptions& options);

    /// Radiance that leaves an object's point against `direction`, which is that of the ray that
    /// found it, of any length; and the point's paint, with the light on it.
    struct OfObject {
        Eigen::Vector3f radiance;
        SurfaceLight light, far;  ///< the latter as far() has it
        Paint paint;
    };
    [[nodiscard]] OfObject ofObject(const RayHit& hit, const Eigen::Vector3f& direction,
                                    const PixelSampler& sampler) const;

    /// Light on a point of an object if nothing stood before it, above 0.
    [[nodiscard]] SurfaceLight far(const SurfacePoint& point,
                                   const Eigen::Vector3f& direction) const;

    /// Radiance of the catcher with the objects there and without them, from the same random
    /// numbers: equal to the bit where no object was met.
    struct OfCatcher {
        Eigen::Vector3f with, without;
    };
    [[nodiscard]] OfCatcher ofCatcher(const RayHit& hit, const Eigen::Vector3f& direction,
                                      const PixelSampler& sampler) const;

private:
    struct World;
    struct Vertex;
    struct Carried;
    /// What leaves the first point of a path, and its diffuse part before the point's paint.
    struct Sent {
        Eigen::Vector3f radiance{0, 0, 0}, white{0, 0, 0};

        Sent& operator+=(const Sent& other) {
            radiance += other.radiance;
            white += other.white;
            return *this;
        }
    };
    /// Light straight from the lights: as the objects let it through, and that of the known lights
    /// as it would be without objects. A wide sun is no known light.
    struct Arrived {
        Sent light, unblocked;
    };
    /// What some lobes of a first surface send to the eye, in parts.
    struct Parts {
        Arrived direct;  ///< straight from the lights
        Sent known;      ///< about the mean of direct.unblocked, without a ray
        Sent rest;       ///< by way of other surfaces
    };
    /// From `point` to `wo`, by these lobes of its.
    [[nodiscard]] Parts walk(SurfacePoint point, Eigen::Vector3f wo, Lobes lobes,
                             const PixelSampler& sampler, World& world) const;
    /// Of sample `number` of a pixel.
    [[nodiscard]] static Sent sum(const Parts& parts, std::uint32_t number);
    [[nodiscard]] Arrived direct(const Vertex& vertex, Lobes lobes, const PixelSampler& sampler,
                                 std::uint32_t pair, World& world) const;
    /// Of one strategy's sample from its density and the other's.
    using Weight = float (*)(float taken, float other);
    /// `far`: radiance by FarLight in the sample's direction.
    [[nodiscard]] static Arrived lit(const Vertex& vertex, Lobes lobes, const LightSample& light,
                                     const Eigen::Vector3f& far, Weight weight, World& world);
    /// Light from a direction in which nothing is, and by FarLight.
    struct Escaped {
        Eigen::Vector3f light{0, 0, 0}, far{0, 0, 0};
    };
    /// Without a ray and without objects.
    [[nodiscard]] Sent known(const Vertex& vertex, const Eigen::Vector3f& wo, Lobes lobes,
                             bool withSun) const;
    [[nodiscard]] Sent knownSky(const Vertex& vertex, const Eigen::Vector3f& wo, Lobes lobes) const;
    /// As of a narrow sun: a wide one's light is off by more the wider it is.
    [[nodiscard]] Sent knownSun(const Vertex& vertex, const Eigen::Vector3f& wo, Lobes lobes) const;
    [[nodiscard]] Escaped escaped(const Eigen::Vector3f& direction, float density) const;
    /// The share of light that is kept of what came from surface number `depth` of a path.
    [[nodiscard]] float kept(const Eigen::Vector3f& light, int depth) const;
    /// Of that light, as the path carries it.
    [[nodiscard]] Sent sent(const Carried& carried, const Eigen::Vector3f& light, int depth) const;

    const TracedScene& scene_;
    const PathTracerOptions& options_;
    SunLight sun_;
    bool sunIsKnown_;
    EnvironmentLight environment_;
    FarLight far_;
    float leastFar_;  // light that is less is not divided by
};

}  // namespace mfar
