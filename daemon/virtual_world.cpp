#include "daemon/virtual_world.h"

#include "pipeline/models/environment_map.h"
#include "pipeline/models/shape_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

// How often the camera's pictures are asked for light [s].
constexpr double kLightInterval = 0.5;
// Light that a shiny thing throws onto others is noise for very many samples; 1 is white as it is
// shown.
constexpr float kBrightestCaustic = 1;

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
        const std::optional<RigidTransform> place = worldPlace(object, tags);
        if (!place) continue;
        if (object.model)
            scene.objects.push_back({object.model, *place, object.scale});
        else
            scene.objects.push_back(
                {std::make_shared<const Model>(shapeModel(object.shape)), *place, 1});
    }
    if (!scene.objects.empty()) scene.lighting = {environmentOf(light), light.sun};
    return scene;
}

VirtualWorld::VirtualWorld(const VirtualOptions& options, const StereoRig& rig, Pipeline& pipeline)
    : options_(options), fullSize_(Pipeline::fullSize(rig)), pipeline_(pipeline),
      traced_(!drawsPreviews(options)) {}

bool VirtualWorld::drawsPreviews(const VirtualOptions& options) {
    return options.rendering == VirtualRendering::Preview || !TracedLayer::isAvailable();
}

TracedLayerOptions VirtualWorld::layerOptions() const {
    const Size output = pipeline_.outputSize();
    const auto scaled = [&](int full, int shown) {
        return std::clamp(static_cast<int>(std::lround(full * options_.resolution)), 1, shown);
    };
    TracedLayerOptions out;
    out.size = {scaled(fullSize_.width, output.width), scaled(fullSize_.height, output.height)};
    out.reference.slices.slicing = options_.slicing;
    out.reference.slices.samples = options_.samples;
    out.reference.slices.samplesPerTurn = 1;  // something is to be seen soon
    out.reference.tracer.shadowReach = kShadowReach;
    out.reference.tracer.fireflyClamp = kBrightestCaustic / static_cast<float>(exposure_);
    out.reference.budgetMs = options_.budgetMs;
    out.reference.threads = options_.threads;
    out.reference.exposure.scale = exposure_;
    out.reference.policy.limits.turnDegrees = options_.turnDeg;
    out.reference.policy.filter = options_.filter;
    out.warp.filling = options_.holes;
    return out;
}

std::string_view VirtualWorld::shapesAlone() const {
    if (traced_) return "";
    if (!TracedLayer::isAvailable()) return "this build has no path tracer";
    return "virtual.rendering = \"preview\" shows simple shapes alone";
}

void VirtualWorld::show(std::shared_ptr<const Scene> scene) {
    if (scene) pipeline_.setScene(std::move(scene), layerOptions());
}

void VirtualWorld::set(const std::vector<PlacedObject>& objects, const LightOptions& light,
                       const TagMap& tags) {
    if (!traced_) {
        pipeline_.setObjects(placedShapes(objects, tags));
        return;
    }
    exposure_ = light.exposure;
    sun_ = light.sun;
    light_.reset();
    lightSeen_.reset();
    if (light.source == LightSource::Camera) light_.emplace();
    Scene scene = sceneOf(objects, light, tags);
    if (scene.objects.empty())
        pipeline_.setScene(nullptr, layerOptions());
    else
        show(follower_.set(std::move(scene)));
}

void VirtualWorld::follow(const ImageView& frame, const CameraModel& video,
                          const std::optional<Pose>& pose, Timestamp time) {
    if (!traced_ || !pose || pipeline_.objectsRegion().empty()) return;
    show(follower_.follow(pipeline_.inverseDepth(), video, pose->T_world_video,
                          pipeline_.objectsRegion(), time));
    const bool due = !lightSeen_ || (time - *lightSeen_).count() > kLightInterval * 1e9;
    if (!light_ || !due) return;
    lightSeen_ = time;
    light_->add(frame, video, pose->T_world_video, time);
    const std::optional<LightEstimate> estimate = light_->estimate();
    if (!estimate) return;
    Lighting lighting = lightingOf(*estimate);
    if (sun_) lighting.sun = sun_;
    show(follower_.relight(std::move(lighting)));
}

}  // namespace mfar
