#include "daemon/virtual_world.h"

#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/models/environment_map.h"
#include "pipeline/models/shape_model.h"
#include "pipeline/scene/scene_parts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace mfar {
namespace {

// Upper limit of the indirect light that each surface on a path adds to a pixel; 1 is white in the
// shown picture. Brighter light is clamped, because it would need very many samples. It comes
// mostly from caustics: shiny objects focus light on other surfaces.
constexpr float kBrightestCaustic = 1;

// Time within which a path-traced picture should be shown [s], see TracedPolicy. Fast processors
// need less for full resolution. On slow ones, 1.2 to 1.8 gave no better pictures.
constexpr double kShownWithin = 0.8;

std::shared_ptr<const Environment> environmentOf(const LightOptions& light) {
    if (light.source == LightSource::File) return light.environment;
    if (light.source == LightSource::Sky)
        return std::make_shared<const Environment>(
            skyEnvironment(light.sun ? light.sun->towards : Sun{}.towards.normalized()));
    return std::make_shared<const Environment>(studioEnvironment());
}

}  // namespace

Scene sceneOf(const std::vector<PlacedObject>& objects, const LightOptions& light,
              const TagMap& tags) {
    Scene scene;
    for (const PlacedObject& object : objects) {
        const std::optional<RigidTransform> anchor = worldAnchor(object, tags);
        if (!anchor) continue;
        const RigidTransform place = *anchor * object.T_anchor_object;
        if (object.model)
            std::ranges::move(partsOf({object.model, place, object.scale, *anchor}),
                              std::back_inserter(scene.objects));
        else
            scene.objects.push_back(
                {std::make_shared<const Model>(shapeModel(object.shape)), place, 1, *anchor});
    }
    if (!scene.objects.empty()) scene.lighting = {environmentOf(light), light.sun};
    return scene;
}

TracedLayerOptions tracedLayerOptions(const VirtualOptions& options, float exposure) {
    TracedLayerOptions out;
    out.renderer.slices.slicing = options.slicing;
    out.renderer.slices.samples = options.samples;
    out.renderer.slices.samplesPerTurn = 1;
    out.renderer.tracer.shadowReach = kShadowReach;
    out.renderer.tracer.fireflyClamp = kBrightestCaustic / exposure;
    out.renderer.budgetMs = options.budgetMs;
    out.renderer.threads = options.threads;
    out.renderer.exposure.scale = exposure;
    out.renderer.policy.limits.turnDegrees = options.turnDeg;
    out.renderer.policy.filter = options.filter;
    // Slicing::Spatial has no samples of the whole picture from which to estimate the speed.
    if (options.slicing == Slicing::Time) out.renderer.policy.shownWithin = kShownWithin;
    out.warp.filling = options.holes;
    return out;
}

Size layerSize(const VirtualOptions& options, Size full, Size output) {
    const auto scaled = [&](int whole, int shown) {
        return std::clamp(static_cast<int>(std::lround(whole * options.resolution)), 1, shown);
    };
    return {scaled(full.width, output.width), scaled(full.height, output.height)};
}

VirtualWorld::VirtualWorld(const VirtualOptions& options, const StereoRig& rig, Pipeline& pipeline)
    : options_(options), fullSize_(Pipeline::fullSize(rig)), pipeline_(pipeline),
      traced_(!drawsPreviews(options)) {}

bool VirtualWorld::drawsPreviews(const VirtualOptions& options) {
    return options.rendering == VirtualRendering::Preview || !TracedLayer::isAvailable();
}

TracedLayerOptions VirtualWorld::layerOptions() const {
    TracedLayerOptions out = tracedLayerOptions(options_, exposure_);
    out.size = layerSize(options_, fullSize_, pipeline_.outputSize());
    return out;
}

std::string_view VirtualWorld::shapesAlone() const {
    if (traced_) return "";
    if (!TracedLayer::isAvailable()) return "this build has no path tracer";
    return "virtual.rendering = \"preview\" shows only simple shapes";
}

void VirtualWorld::set(const std::vector<PlacedObject>& objects, const LightOptions& light,
                       const TagMap& tags) {
    if (!traced_) {
        pipeline_.setObjects(placedShapes(objects, tags));
        return;
    }
    exposure_ = light.exposure;
    std::optional<LightFollower> seen;
    if (light.source == LightSource::Camera) seen.emplace(light.sun);
    pipeline_.setScene(sceneOf(objects, light, tags), layerOptions(), std::move(seen));
}

}  // namespace mfar
