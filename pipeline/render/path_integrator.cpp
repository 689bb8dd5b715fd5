#include "pipeline/render/path_integrator.h"

#include "base/luminance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

constexpr std::uint32_t kSunPair = 0, kEnvironmentPair = 1, kScatterPair = 2, kRoulettePair = 3;
constexpr std::uint32_t kPairsOfVertex = 4;
constexpr std::uint32_t kPairsOfPath = kPairsOfVertex * 64;
// The pairs of emissive triangles come after those of both walks of a sample, so that a scene
// without emission uses the same numbers as if there were no emission at all.
constexpr std::uint32_t kEmitterPair = 2 * kPairsOfPath, kFineEmitterPair = kEmitterPair + 1;
// A path that carries at least this share of the light always survives. Ending such paths at random
// would add much noise, also with a good sampler.
constexpr float kSurvives = 0.25F;

/// Balance heuristic for one sample from each of two densities (Veach 1997, equation 9.8). The
/// density of EnvironmentLight is made for this heuristic (MIS compensation).
float balanceWeight(float taken, float other) {
    return taken / (taken + other);
}

/// Power heuristic (Veach 1997, equation 9.13) for the sun and emissive triangles. Samples of a
/// broad lobe rarely hit them. With the balance heuristic, these few samples would be very bright.
float powerWeight(float taken, float other) {
    const float ratio = other / taken;
    return 1 / (1 + ratio * ratio);
}

constexpr float kLeastFarShare = 0.05F, kLeastFar = 1e-6F;
// Largest angular radius [rad] of a sun whose light is computed without a ray.
constexpr float kWidestKnownSun = 0.05F;

}  // namespace

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

    /// True if nothing hides the sampled point. The ray must hit the sampled triangle itself. So of
    /// two triangles in the same place, only the one that other rays hit gives light, and the holes
    /// of an alpha mask give none.
    bool sees(const EmissiveTriangles::Sample& sample) {
        Ray ray = sample.ray;
        const RayHit hit = scene.objects().first(ray);
        if (hit.mesh != sample.point.mesh || hit.triangle != sample.point.triangle) return false;
        ray.most = hit.t;
        if (!scene.catcher().empty() && scene.catcher().blocked(ray)) return false;
        touched = true;
        return true;
    }

    /// Returns the point that a ray hits. `density` is the one of the ray's direction. The point's
    /// emission is multiplied by its weight in multiple importance sampling.
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

    /// True if the triangle faces `direction`. The shading normal may face another side.
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

PathIntegrator::PathIntegrator(const TracedScene& scene, const PathTracerOptions& options,
                               std::shared_ptr<const DistantLight> light)
    : scene_(scene), options_(options), light_(std::move(light)), sun_(light_->sun),
      sunIsKnown_(sun_.angularRadius() <= kWidestKnownSun), environment_(light_->environment),
      emitters_(options.emissionByChance ? EmissiveTriangles() : EmissiveTriangles(scene)),
      far_(light_->far), leastFar_(std::max(kLeastFarShare * far_.brightness(), kLeastFar)) {}

PathIntegrator::Lights PathIntegrator::sampledLights(const PixelSampler& sampler,
                                                     std::uint32_t pair) const {
    Lights out;
    if (!sun_.dark()) {
        const LightSample light = sun_.sample(sampler.pair(pair + kSunPair));
        const Eigen::Vector3f far = sunIsKnown_ ? light.radiance : Eigen::Vector3f(0, 0, 0);
        out.sun = {light, far, powerWeight, {}};
    }
    if (environment_.sampled()) {
        const LightSample light = environment_.sample(sampler.pair(pair + kEnvironmentPair));
        out.environment = {
            light, far_.radiance(light.direction, light.radiance), balanceWeight, {}};
    }
    return out;
}

PathIntegrator::Arrived PathIntegrator::lit(const Vertex& vertex, Lobes lobes,
                                            SampledLight& sampled, World& world) {
    const LightSample& light = sampled.light;
    if (!(light.density > 0)) return {};
    const ScatterValue f =
        vertex.scatter.evaluate(vertex.frame.transpose() * light.direction, lobes);
    if (!(f.density > 0)) return {};
    const float share = sampled.weight(light.density, f.density) / light.density;
    const auto sent = [&](const Eigen::Vector3f& radiance) {
        return Sent{f.value.cwiseProduct(radiance) * share, radiance * (f.white * share)};
    };
    if (!sampled.reaches)
        sampled.reaches =
            vertex.faces(light.direction) && !world.blocked(vertex.point.leaving(light.direction));
    Arrived out;
    out.unblocked = sent(sampled.far);
    if (*sampled.reaches) out.light = sent(light.radiance);
    return out;
}

PathIntegrator::Arrived PathIntegrator::direct(const Vertex& vertex, Lobes lobes, Lights& lights,
                                               World& world) {
    Arrived sum = lit(vertex, lobes, lights.sun, world);
    const Arrived sky = lit(vertex, lobes, lights.environment, world);
    sum.light += sky.light;
    sum.unblocked += sky.unblocked;
    return sum;
}

PathIntegrator::Sent PathIntegrator::emitted(const Vertex& vertex, Lobes lobes,
                                             const PixelSampler& sampler, std::uint32_t pair,
                                             World& world) const {
    if (!world.objects) return {};
    // The ray starts off the surface, like a reflected one.
    const Eigen::Vector3f from = vertex.point.leaving(vertex.point.geometric).origin;
    const EmissiveTriangles::Sample sample = emitters_.sample(
        from, sampler.pair(pair + kEmitterPair), sampler.pair(pair + kFineEmitterPair).x());
    if (!(sample.density > 0) || !vertex.faces(sample.ray.direction)) return {};
    const ScatterValue f =
        vertex.scatter.evaluate(vertex.frame.transpose() * sample.ray.direction, lobes);
    if (!(f.density > 0) || !world.sees(sample)) return {};
    const Eigen::Vector3f light =
        scene_.emission(sample.point) * (powerWeight(sample.density, f.density) / sample.density);
    return {f.value.cwiseProduct(light), f.white * light};
}

PathIntegrator::Escaped PathIntegrator::escaped(const Eigen::Vector3f& direction,
                                                float density) const {
    Escaped sum;
    if (const float other = sun_.density(direction); other > 0)
        sum.light = sun_.radiance(direction) * powerWeight(density, other);
    if (sunIsKnown_) sum.far = sum.light;
    const EnvironmentLight::Seen sky = environment_.seen(direction);
    const float weight = balanceWeight(density, sky.density);
    sum.light += weight * sky.radiance;
    sum.far += weight * far_.radiance(direction, sky.radiance);
    return sum;
}

PathIntegrator::Sent PathIntegrator::known(const Vertex& vertex, Lobes lobes, bool withSun) const {
    Sent sum = knownSky(vertex, lobes);
    if (withSun) sum += knownSun(vertex, lobes);
    return sum;
}

PathIntegrator::Sent PathIntegrator::knownSky(const Vertex& vertex, Lobes lobes) const {
    if (far_.dark()) return {};
    Sent sum;
    const SurfacePoint& point = vertex.point;
    const Reflectance& share = vertex.scatter.reflectance();
    if (lobes == Lobes::Mirrored) {
        const Eigen::Vector3f towards =
            2 * point.shading.dot(vertex.wo) * point.shading - vertex.wo;
        sum.radiance = share.mirrored.cwiseProduct(far_.mirrored(towards, point.look.roughness));
    } else {
        const Eigen::Vector3f even = far_.diffuse(point.shading);
        sum.white = share.white * even;
        sum.radiance =
            (share.white * vertex.scatter.diffuseColour() + share.manyfold).cwiseProduct(even);
    }
    return sum;
}

PathIntegrator::Sent PathIntegrator::knownSun(const Vertex& vertex, Lobes lobes) const {
    if (sun_.dark()) return {};
    const SurfacePoint& point = vertex.point;
    const Eigen::Vector3f towards = vertex.frame.transpose() * sun_.towards();
    // The lobe is evaluated only at the centre of the sun's disc. A lobe narrower than the disc
    // would give a wrong value, so the roughness is raised until it is about as wide.
    SurfaceLook look = point.look;
    look.roughness = std::max(look.roughness, std::sqrt(sun_.angularRadius()));
    const ScatterValue f =
        lobes == Lobes::Mirrored && look.roughness > point.look.roughness
            ? SurfaceScatter(look, vertex.frame.transpose() * vertex.wo).evaluate(towards, lobes)
            : vertex.scatter.evaluate(towards, lobes);
    return {f.value.cwiseProduct(sun_.irradiance()), f.white * sun_.irradiance()};
}

float PathIntegrator::kept(const Eigen::Vector3f& light, int depth) const {
    const float most = light.maxCoeff();
    if (depth < 2 || !(options_.fireflyClamp > 0) || !(most > options_.fireflyClamp)) return 1;
    return options_.fireflyClamp / most;
}

PathIntegrator::Sent PathIntegrator::sent(const Carried& carried, const Eigen::Vector3f& light,
                                          int depth) const {
    const Eigen::Vector3f all = carried.all.cwiseProduct(light);
    const float share = kept(all, depth);
    return {all * share, carried.white.cwiseProduct(light) * share};
}

bool PathIntegrator::survives(Carried& carried, int depth, const PixelSampler& sampler,
                              std::uint32_t pair) const {
    return depth < options_.rouletteDepth ||
           carried.survives(sampler.pair(pair + kRoulettePair).x());
}

PathIntegrator::Parts PathIntegrator::walk(const Vertex& begin, Lobes lobes, Lights& lights,
                                           const PixelSampler& sampler, World& world) const {
    Parts out;
    std::uint32_t pair = kCameraPairs + (lobes == Lobes::Mirrored ? kPairsOfPath : 0);
    Carried carried;
    const Vertex* vertex = &begin;
    std::optional<Vertex> reached;
    for (int depth = 1;; ++depth, pair += kPairsOfVertex) {
        const bool first = depth == 1, last = depth == options_.maxDepth;
        const Lobes here = first ? lobes : Lobes::Both;
        // The walk with Lobes::Broad already adds the first surface's own emission. Emission of the
        // second surface counts as direct light (depth 1).
        if (!first || lobes != Lobes::Mirrored)
            out.rest += sent(carried, vertex->point.emission, depth - 1);
        if (first) {
            out.direct = direct(*vertex, here, lights, world);
        } else {
            Lights own = sampledLights(sampler, pair);
            out.rest += sent(carried, direct(*vertex, here, own, world).light.radiance, depth);
        }
        if (!last && !emitters_.dark()) {
            const Sent light = emitted(*vertex, here, sampler, pair, world);
            out.rest += first ? light : sent(carried, light.radiance, depth);
        }
        const ScatterSample scattered =
            vertex->scatter.sample(sampler.pair(pair + kScatterPair), here);
        if (!(scattered.density > 0)) return out;
        const Eigen::Vector3f direction = vertex->frame * scattered.wi;
        carried.scatter(scattered, first);
        std::optional<Escaped> sky;
        if (first) {
            sky = escaped(direction, scattered.density);
            out.direct.unblocked += sent(carried, sky->far, depth);
        }
        if (!vertex->faces(direction) || !survives(carried, depth, sampler, pair)) return out;
        const Ray ray = vertex->point.leaving(direction);
        std::optional<SurfacePoint> next;
        // At the last surface, the ray only tests if the lights in the sampled direction are
        // visible. That completes the multiple importance sampling.
        const bool free = last ? !world.blocked(ray) : !(next = world.next(ray, scattered.density));
        if (free) {
            if (!sky) sky = escaped(direction, scattered.density);
            (first ? out.direct.light : out.rest) += sent(carried, sky->light, depth);
        }
        if (free || last) return out;
        vertex = &reached.emplace(*next, -direction);
    }
}

// Replaces the sampled unblocked light by known light, scaled by the share that objects do not
// block (Heitz et al. 2018). Where nothing blocks light, the result has no noise. Known light has
// an error of a few percent, so its weight falls after 16 samples.
PathIntegrator::Sent PathIntegrator::sum(const Parts& parts, std::uint32_t number) {
    constexpr std::uint32_t kTrusted = 16;
    const Arrived& direct = parts.direct;
    Sent out = parts.rest;
    out += direct.light;
    const float unblocked = luminanceOf(direct.unblocked.radiance);
    float trust =
        number < kTrusted ? 1.0F : static_cast<float>(kTrusted) / static_cast<float>(number);
    if (unblocked > 0) trust *= std::min(1.0F, luminanceOf(direct.light.radiance) / unblocked);
    out += {trust * (parts.known.radiance - direct.unblocked.radiance),
            trust * (parts.known.white - direct.unblocked.white)};
    return out;
}

PathIntegrator::OfObject PathIntegrator::ofObject(const RayHit& hit,
                                                  const Eigen::Vector3f& direction,
                                                  const PixelSampler& sampler) const {
    const Vertex vertex(scene_.objectPoint(hit, direction), -direction.normalized());
    World all{scene_, emitters_, true};
    // Both walks share the lights' samples, so that each needs one ray.
    Lights lights = sampledLights(sampler, kCameraPairs);
    Sent sent, known;
    const auto add = [&](Lobes lobes) {
        Parts parts = walk(vertex, lobes, lights, sampler, all);
        parts.known = knownSky(vertex, lobes);
        const Sent sun = knownSun(vertex, lobes);
        Sent whole = parts.known;
        whole += sun;
        known += whole;
        if (sunIsKnown_) parts.known = whole;
        sent += sum(parts, sampler.number());
    };
    add(Lobes::Broad);
    if (!vertex.point.look.matt) add(Lobes::Mirrored);
    sent.radiance = sent.radiance.cwiseMax(0.0F);
    sent.white = sent.white.cwiseMax(0.0F);
    const Paint paint = vertex.point.paint(direction);
    return {sent.radiance, lightOf(sent.radiance, sent.white, paint), far(known, paint), paint};
}

SurfaceLight PathIntegrator::far(const SurfacePoint& point,
                                 const Eigen::Vector3f& direction) const {
    const Vertex vertex(point, -direction.normalized());
    Sent sent = known(vertex, Lobes::Broad, true);
    if (!point.look.matt) sent += known(vertex, Lobes::Mirrored, true);
    return far(sent, point.paint(direction));
}

SurfaceLight PathIntegrator::far(const Sent& known, const Paint& paint) const {
    SurfaceLight out = lightOf(known.radiance, known.white, paint);
    out.diffuse = out.diffuse.cwiseMax(leastFar_);
    out.specular = out.specular.cwiseMax(leastFar_);
    return out;
}

MirrorLight PathIntegrator::mirrorLight() const {
    MirrorLight out = far_.tables();
    out.least = leastFar_;
    out.leastSunAlpha = sun_.angularRadius();
    if (sun_.dark() || !sunIsKnown_) return out;
    for (int c = 0; c < 3; ++c) {
        out.towardsSun[static_cast<std::size_t>(c)] = sun_.towards()[c];
        out.sunIrradiance[static_cast<std::size_t>(c)] = sun_.irradiance()[c];
    }
    return out;
}

PathIntegrator::OfCatcher PathIntegrator::ofCatcher(const RayHit& hit,
                                                    const Eigen::Vector3f& direction,
                                                    const PixelSampler& sampler) const {
    const Vertex vertex(scene_.catcherPoint(hit, direction), -direction.normalized());
    World all{scene_, emitters_, true}, real{scene_, emitters_, false};
    const auto radiance = [&](World& world) {
        Lights lights = sampledLights(sampler, kCameraPairs);
        const Parts parts = walk(vertex, Lobes::Both, lights, sampler, world);
        return Eigen::Vector3f(parts.direct.light.radiance + parts.rest.radiance);
    };
    OfCatcher out;
    out.with = radiance(all);
    out.without = all.touched ? radiance(real) : out.with;
    return out;
}

}  // namespace mfar
