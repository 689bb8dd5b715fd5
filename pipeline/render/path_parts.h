#pragma once

#include "pipeline/render/path_integrator.h"

#include <algorithm>
#include <optional>

// Parts of PathIntegrator that only path_integrator.cpp uses.
namespace mfar {

// Russian roulette never ends a path that carries at least this share of the light. Ending such
// paths would add much noise, even with well distributed random numbers.
inline constexpr float kSurvives = 0.25F;

/// Balance heuristic for one sample from each of two densities (Veach 1997, equation 9.8). The
/// density of EnvironmentLight is made for this heuristic (MIS compensation).
inline float balanceWeight(float taken, float other) {
    return taken / (taken + other);
}

/// Power heuristic (Veach 1997, equation 9.13) for the sun and emissive triangles. Samples of a
/// broad lobe rarely hit them. With the balance heuristic, these few samples would be very bright.
inline float powerWeight(float taken, float other) {
    const float ratio = other / taken;
    return 1 / (1 + ratio * ratio);
}

struct PathIntegrator::World {
    const TracedScene& scene;
    const EmissiveTriangles& emitters;
    bool objects;
    bool touched = false;

    bool blocked(const Ray& ray) {
        if (objects && !scene.objects().empty() && scene.objects().blocked(ray)) {
            touched = true;
            return true;
        }
        return !scene.catcher().empty() && scene.catcher().blocked(ray);
    }

    /// True if nothing hides the sampled point: the first triangle that the ray hits must be the
    /// sampled one. If two triangles coincide, only the one that RayScene::first() returns gives
    /// light. next() finds the same one, so light that is sampled and light that is hit by chance
    /// agree. Holes of an alpha mask give no light.
    bool sees(const EmissiveTriangles::Sample& sample) {
        Ray ray = sample.ray;
        const RayHit hit = scene.objects().first(ray);
        if (hit.mesh != sample.point.mesh || hit.triangle != sample.point.triangle) return false;
        ray.most = hit.t;
        if (!scene.catcher().empty() && scene.catcher().blocked(ray)) return false;
        touched = true;
        return true;
    }

    /// Returns the point that a ray hits. `density` is the probability density with which the ray's
    /// direction was sampled. The point's emission is multiplied by the weight of this sample in
    /// multiple importance sampling.
    std::optional<SurfacePoint> next(Ray ray, float density) {
        RayHit object;
        if (objects && !scene.objects().empty()) object = scene.objects().first(ray);
        if (object.found()) {
            touched = true;
            ray.most = object.t;
        }
        const RayHit real = scene.catcher().empty() ? RayHit{} : scene.catcher().first(ray);
        if (real.found()) return scene.catcherPoint(real, ray.direction);
        if (!object.found()) return std::nullopt;
        SurfacePoint point = scene.objectPoint(object, ray.direction);
        if (!emitters.dark()) point.emission *= powerWeight(density, emitters.density(ray, object));
        return point;
    }
};

/// A surface point of a path. `wo` is the direction to the point before it.
struct PathIntegrator::Vertex {
    SurfacePoint point;
    Eigen::Vector3f wo;
    Eigen::Matrix3f frame;
    SurfaceScatter scatter;

    Vertex(const SurfacePoint& p, const Eigen::Vector3f& towards)
        : point(p), wo(towards), frame(frameAround(p.shading)),
          scatter(p.look, frame.transpose() * towards) {}

    /// True if the triangle faces `direction`. The shading normal is not tested.
    [[nodiscard]] bool faces(const Eigen::Vector3f& direction) const {
        return point.geometric.dot(direction) > 0;
    }
};

struct PathIntegrator::Carried {
    Eigen::Vector3f all{1, 1, 1}, white{0, 0, 0};

    void scatter(const ScatterSample& sample, bool first) {
        all = all.cwiseProduct(sample.weight);
        if (first)
            white.setConstant(sample.white);
        else
            white = white.cwiseProduct(sample.weight);
    }
    bool survives(float random) {
        const float chance = std::min(1.0F, all.maxCoeff() / kSurvives);
        if (!(random < chance)) return false;
        all /= chance;
        white /= chance;
        return true;
    }
};

struct PathIntegrator::Lights {
    SampledLight sun, environment;
};

/// The state of a walk from surface to surface.
struct PathIntegrator::Walk {
    const PixelSampler& sampler;
    World& world;
    Lobes lobes;         ///< lobes of the first surface
    std::uint32_t pair;  ///< index of the vertex's first random pair
    int depth = 1;       ///< number of surfaces so far
    Carried carried{};
    Parts out{};
    std::optional<Vertex> reached{};  ///< the surface that scatter() reached last

    [[nodiscard]] bool isFirst() const { return depth == 1; }
    [[nodiscard]] Lobes lobesHere() const { return isFirst() ? lobes : Lobes::Both; }
};

}  // namespace mfar
