#include "pipeline/render/path_integrator.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// Pairs of random numbers of each vertex.
constexpr std::uint32_t kSunPair = 0, kEnvironmentPair = 1, kScatterPair = 2, kRoulettePair = 3;
constexpr std::uint32_t kPairsOfVertex = 4;
// Paths that still bring so much of the light go on for sure: what ends them adds noise that no
// sampler makes up for.
constexpr float kSurvives = 0.25F;

/// Balance heuristic of one sample from each of two densities (Veach 1997, equation 9.8): the one
/// that the environment's compensated density is made for.
float balanceWeight(float taken, float other) {
    return taken / (taken + other);
}

/// Power heuristic (equation 9.13), for the sun: what a broad lobe finds of it would be rare and
/// bright.
float powerWeight(float taken, float other) {
    const float ratio = other / taken;
    return 1 / (1 + ratio * ratio);
}

}  // namespace

/// What rays meet: all, or the catcher alone.
struct PathIntegrator::World {
    const TracedScene& scene;
    bool objects;
    bool touched = false;  // an object was in a ray's way

    bool blocked(const Ray& ray) {
        if (objects && !scene.objects().empty() && scene.objects().blocked(ray)) {
            touched = true;
            return true;
        }
        return !scene.catcher().empty() && scene.catcher().blocked(ray);
    }

    std::optional<SurfacePoint> next(Ray ray) {
        RayHit object;
        if (objects && !scene.objects().empty()) object = scene.objects().first(ray);
        if (object.found()) {
            touched = true;
            ray.most = object.t;
        }
        const RayHit real = scene.catcher().empty() ? RayHit{} : scene.catcher().first(ray);
        if (real.found()) return scene.catcherPoint(real, ray.direction);
        if (object.found()) return scene.objectPoint(object, ray.direction);
        return std::nullopt;
    }
};

/// A point with light scattered at it.
struct PathIntegrator::Vertex {
    const SurfacePoint& point;
    Eigen::Matrix3f frame;
    SurfaceScatter scatter;

    Vertex(const SurfacePoint& p, const Eigen::Vector3f& wo)
        : point(p), frame(frameAround(p.shading)), scatter(p.look, frame.transpose() * wo) {}

    /// Whether the triangle itself and not only its shading faces there.
    [[nodiscard]] bool faces(const Eigen::Vector3f& direction) const {
        return point.geometric.dot(direction) > 0;
    }
};

PathIntegrator::PathIntegrator(const TracedScene& scene, const PathTracerOptions& options)
    : scene_(scene), options_(options), sun_(scene.scene().lighting.sun),
      environment_(scene.scene().lighting.environment) {}

PathIntegrator::Sent PathIntegrator::lit(const Vertex& vertex, const LightSample& light,
                                         Weight weight, World& world) {
    if (!(light.density > 0) || !vertex.faces(light.direction)) return {};
    const ScatterValue f = vertex.scatter.evaluate(vertex.frame.transpose() * light.direction);
    if (!(f.density > 0)) return {};
    if (world.blocked(vertex.point.leaving(light.direction))) return {};
    const float share = weight(light.density, f.density) / light.density;
    return {f.value.cwiseProduct(light.radiance) * share, light.radiance * (f.white * share)};
}

PathIntegrator::Sent PathIntegrator::direct(const Vertex& vertex, const PixelSampler& sampler,
                                            std::uint32_t pair, World& world) const {
    Sent sum;
    const auto add = [&](const Sent& sent) {
        sum.radiance += sent.radiance;
        sum.white += sent.white;
    };
    if (!sun_.dark())
        add(lit(vertex, sun_.sample(sampler.pair(pair + kSunPair)), powerWeight, world));
    if (environment_.sampled())
        add(lit(vertex, environment_.sample(sampler.pair(pair + kEnvironmentPair)), balanceWeight,
                world));
    return sum;
}

Eigen::Vector3f PathIntegrator::escaped(const Eigen::Vector3f& direction, float density) const {
    Eigen::Vector3f sum{0, 0, 0};
    if (const float other = sun_.density(direction); other > 0)
        sum += sun_.radiance(direction) * powerWeight(density, other);
    if (!environment_.dark())
        sum += environment_.radiance(direction) *
               balanceWeight(density, environment_.density(direction));
    return sum;
}

float PathIntegrator::kept(const Eigen::Vector3f& light, int depth) const {
    const float most = light.maxCoeff();
    if (depth < 2 || !(options_.fireflyClamp > 0) || !(most > options_.fireflyClamp)) return 1;
    return options_.fireflyClamp / most;
}

PathIntegrator::Sent PathIntegrator::walk(SurfacePoint point, Eigen::Vector3f wo,
                                          const PixelSampler& sampler, World& world) const {
    Sent sum;
    Eigen::Vector3f throughput{1, 1, 1}, whiteThroughput{0, 0, 0};  // white: none before a bounce
    const auto add = [&](const Eigen::Vector3f& light, int depth) {
        const Eigen::Vector3f sent = throughput.cwiseProduct(light);
        const float share = kept(sent, depth);
        sum.radiance += sent * share;
        sum.white += whiteThroughput.cwiseProduct(light) * share;
    };
    for (int depth = 1;; ++depth) {
        const std::uint32_t pair =
            kCameraPairs + static_cast<std::uint32_t>(depth - 1) * kPairsOfVertex;
        // What shines at the second surface is direct light of the first.
        add(point.emission, depth - 1);
        const Vertex vertex(point, wo);
        const Sent lit = direct(vertex, sampler, pair, world);
        add(lit.radiance, depth);
        if (depth == 1) sum.white += lit.white;

        const ScatterSample out = vertex.scatter.sample(sampler.pair(pair + kScatterPair));
        if (!(out.density > 0)) return sum;
        const Eigen::Vector3f direction = vertex.frame * out.wi;
        if (!vertex.faces(direction)) return sum;
        throughput = throughput.cwiseProduct(out.weight);
        if (depth == 1)
            whiteThroughput.setConstant(out.white);
        else
            whiteThroughput = whiteThroughput.cwiseProduct(out.weight);
        if (depth >= options_.rouletteDepth) {
            const float chance = std::min(1.0F, throughput.maxCoeff() / kSurvives);
            if (!(sampler.pair(pair + kRoulettePair).x() < chance)) return sum;
            throughput /= chance;
            whiteThroughput /= chance;
        }
        const Ray ray = point.leaving(direction);
        if (depth == options_.maxDepth) {
            // The lights' other half of the last vertex.
            if (!world.blocked(ray)) add(escaped(direction, out.density), depth);
            return sum;
        }
        const std::optional<SurfacePoint> next = world.next(ray);
        if (!next) {
            add(escaped(direction, out.density), depth);
            return sum;
        }
        point = *next;
        wo = -direction;
    }
}

PathIntegrator::OfObject PathIntegrator::ofObject(const RayHit& hit,
                                                  const Eigen::Vector3f& direction,
                                                  const PixelSampler& sampler) const {
    const SurfacePoint point = scene_.objectPoint(hit, direction);
    World all{scene_, true};
    const Sent sent = walk(point, -direction.normalized(), sampler, all);
    const Paint paint = point.paint(direction);
    return {sent.radiance, lightOf(sent.radiance, sent.white, paint), paint};
}

PathIntegrator::OfCatcher PathIntegrator::ofCatcher(const RayHit& hit,
                                                    const Eigen::Vector3f& direction,
                                                    const PixelSampler& sampler) const {
    const SurfacePoint point = scene_.catcherPoint(hit, direction);
    const Eigen::Vector3f wo = -direction.normalized();
    World all{scene_, true}, real{scene_, false};
    OfCatcher out;
    out.with = walk(point, wo, sampler, all).radiance;
    out.without = all.touched ? walk(point, wo, sampler, real).radiance : out.with;
    return out;
}

}  // namespace mfar
