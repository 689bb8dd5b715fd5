#include "pipeline/render/path_integrator.h"

#include "base/luminance.h"
#include "pipeline/render/path_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

constexpr std::uint32_t kSunPair = 0, kEnvironmentPair = 1, kScatterPair = 2, kRoulettePair = 3;
constexpr std::uint32_t kPairsOfVertex = 4;
constexpr std::uint32_t kPairsOfPath = kPairsOfVertex * 64;
// A sample makes two walks. The random pairs for emissive triangles are numbered after all pairs of
// both walks. So everything else gets the same random numbers with and without emissive triangles.
constexpr std::uint32_t kEmitterPair = 2 * kPairsOfPath, kFineEmitterPair = kEmitterPair + 1;
constexpr float kLeastFarShare = 0.05F, kLeastFar = 1e-6F;
// Largest angular radius [rad] of a sun whose light is computed without a ray.
constexpr float kWidestKnownSun = 0.05F;

}  // namespace

PathIntegrator::PathIntegrator(const TracedScene& scene, const PathTracerOptions& options,
                               std::shared_ptr<const DistantLight> light,
                               EmissiveTriangles emitters)
    : scene_(scene), options_(options), light_(std::move(light)), sun_(light_->sun),
      sunIsKnown_(sun_.angularRadius() <= kWidestKnownSun), environment_(light_->environment),
      emitters_(std::move(emitters)), far_(light_->far),
      leastFar_(std::max(kLeastFarShare * far_.brightness(), kLeastFar)) {}

PathIntegrator::PathIntegrator(const TracedScene& scene, const PathTracerOptions& options,
                               std::shared_ptr<const DistantLight> light)
    : PathIntegrator(scene, options, std::move(light),
                     options.emissionByChance ? EmissiveTriangles() : EmissiveTriangles(scene)) {}

PathIntegrator::PathIntegrator(const PathIntegrator& other, const TracedScene& posed,
                               const PathTracerOptions& options)
    : PathIntegrator(posed, options, other.light_, EmissiveTriangles(other.emitters_, posed)) {}

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
    // The ray starts a little above the surface, as a reflected ray does.
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
    // would give a wrong value, so the roughness is raised until the lobe is about as wide.
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

void PathIntegrator::addDirect(const Vertex& vertex, Lights& lights, Walk& walk) const {
    Parts& out = walk.out;
    // The emission of this surface is direct light of the preceding surface on the path. So it is
    // sent with the depth of the preceding surface. At the first surface, only the walk with
    // Lobes::Broad adds the emission, because the walk with Lobes::Mirrored begins there, too.
    if (!walk.isFirst() || walk.lobes != Lobes::Mirrored)
        out.rest += sent(walk.carried, vertex.point.emission, walk.depth - 1);
    const Arrived arrived = direct(vertex, walk.lobesHere(), lights, walk.world);
    if (walk.isFirst())
        out.direct = arrived;
    else
        out.rest += sent(walk.carried, arrived.light.radiance, walk.depth);
    if (walk.depth == options_.maxDepth || emitters_.dark()) return;
    const Sent light = emitted(vertex, walk.lobesHere(), walk.sampler, walk.pair, walk.world);
    out.rest += walk.isFirst() ? light : sent(walk.carried, light.radiance, walk.depth);
}

bool PathIntegrator::scatter(const Vertex& vertex, Walk& walk) const {
    Parts& out = walk.out;
    const bool first = walk.isFirst(), last = walk.depth == options_.maxDepth;
    const ScatterSample scattered =
        vertex.scatter.sample(walk.sampler.pair(walk.pair + kScatterPair), walk.lobesHere());
    if (!(scattered.density > 0)) return false;
    const Eigen::Vector3f direction = vertex.frame * scattered.wi;
    walk.carried.scatter(scattered, first);
    std::optional<Escaped> sky;
    if (first) {
        sky = escaped(direction, scattered.density);
        out.direct.unblocked += sent(walk.carried, sky->far, walk.depth);
    }
    if (!vertex.faces(direction) || !survives(walk.carried, walk.depth, walk.sampler, walk.pair))
        return false;
    const Ray ray = vertex.point.leaving(direction);
    std::optional<SurfacePoint> next;
    // At the last surface, the ray only tests if the lights in the sampled direction are visible.
    // That completes the multiple importance sampling.
    const bool free =
        last ? !walk.world.blocked(ray) : !(next = walk.world.next(ray, scattered.density));
    if (free) {
        if (!sky) sky = escaped(direction, scattered.density);
        (first ? out.direct.light : out.rest) += sent(walk.carried, sky->light, walk.depth);
    }
    if (free || last) return false;
    walk.reached.emplace(*next, -direction);
    return true;
}

PathIntegrator::Parts PathIntegrator::walk(const Vertex& first, Lobes lobes, Lights& lights,
                                           const PixelSampler& sampler, World& world) const {
    Walk walk{sampler, world, lobes, kCameraPairs + (lobes == Lobes::Mirrored ? kPairsOfPath : 0)};
    addDirect(first, lights, walk);
    bool goesOn = scatter(first, walk);
    while (goesOn) {
        ++walk.depth;
        walk.pair += kPairsOfVertex;
        Lights own = sampledLights(sampler, walk.pair);
        addDirect(*walk.reached, own, walk);
        goesOn = scatter(*walk.reached, walk);
    }
    return walk.out;
}

float PathIntegrator::unblockedShare(const Arrived& direct, float otherwise) {
    const float unblocked = luminanceOf(direct.unblocked.radiance);
    return unblocked > 0 ? std::min(1.0F, luminanceOf(direct.light.radiance) / unblocked)
                         : otherwise;
}

// Replaces sampled light by `known`, an approximation without noise of the direct light that would
// arrive if nothing blocked it. If objects block a share of the light, only the rest is replaced
// (Heitz et al. 2018). So the result has no noise where nothing blocks light. `known` has an error
// of a few percent, so its weight falls after 16 samples.
PathIntegrator::Sent PathIntegrator::sum(const Parts& parts, const Sent& known, float open,
                                         std::uint32_t number) {
    constexpr std::uint32_t kTrusted = 16;
    const Arrived& direct = parts.direct;
    Sent out = parts.rest;
    out += direct.light;
    const float trust =
        open *
        (number < kTrusted ? 1.0F : static_cast<float>(kTrusted) / static_cast<float>(number));
    out += {trust * (known.radiance - direct.unblocked.radiance),
            trust * (known.white - direct.unblocked.white)};
    return out;
}

PathIntegrator::OfObject PathIntegrator::ofObject(const RayHit& hit,
                                                  const Eigen::Vector3f& direction,
                                                  const PixelSampler& sampler) const {
    const Vertex vertex(scene_.objectPoint(hit, direction), -direction.normalized());
    World all{scene_, emitters_, true};
    // The walks for broad and for mirrored reflection use the same light samples, so that only one
    // shadow ray is traced for each light sample.
    Lights lights = sampledLights(sampler, kCameraPairs);
    Sent sent, known;
    float open = 1;
    const auto add = [&](Lobes lobes) {
        const Parts parts = walk(vertex, lobes, lights, sampler, all);
        const Sent sky = knownSky(vertex, lobes);
        Sent whole = sky;
        whole += knownSun(vertex, lobes);
        known += whole;
        // If this walk sampled no direct light, its share of unblocked light is unknown. Then the
        // share of the first walk is used, or 1 in the first walk itself.
        open = unblockedShare(parts.direct, open);
        sent += sum(parts, sunIsKnown_ ? whole : sky, open, sampler.number());
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
