#include "pipeline/traced_layer.h"

#include "pipeline/scene/scene_parts.h"
#include "pipeline/slices/traced_renderer.h"
#include "pipeline/warp/warp.h"

#include <utility>
#include <vector>

namespace mfar {

struct TracedLayer::State {
    State(const CameraModel& video, Engine& warps, const TracedLayerOptions& options)
        : camera(video.scaledTo(options.size)), warp(camera, options.size, warps, options.warp),
          renderer(options.renderer), fadeFrames(options.warp.fadeFrames) {}

    void take(const RenderedPicture& picture) {
        if (picture.scene != scene) {
            // Discards the re-rendered pictures, even if the new scene differs only in its light.
            scene = picture.scene;
            warp.setScene(*scene);
        }
        warp.setTracedPicture(tracedPicture(picture));
        shown = &picture;
        changing = std::max(changing, 1);
    }

    [[nodiscard]] bool isMoving() const { return scene && moves(*scene); }

    CameraModel camera;
    Warp warp;
    TracedRenderer renderer;
    int fadeFrames;
    std::shared_ptr<const Scene> scene;
    Timestamp time;
    // Address of the shown picture, for comparison with the address of the next picture. The
    // picture is not accessed through it.
    const RenderedPicture* shown = nullptr;
    // Number of further frames in which new results of the path tracer change the layer, even if
    // the camera rests.
    int changing = 0;
};

bool TracedLayer::isAvailable() {
    return true;
}

TracedLayer::TracedLayer(const CameraModel& video, Engine& warps, const TracedLayerOptions& options)
    : state_(std::make_unique<State>(video, warps, options)) {}
TracedLayer::~TracedLayer() = default;

void TracedLayer::setScene(std::shared_ptr<const Scene> scene) {
    state_->renderer.setScene(std::move(scene));
}

void TracedLayer::update(const RigidTransform& T_world_video, Timestamp time) {
    State& s = *state_;
    s.time = time;
    s.renderer.update({s.camera, T_world_video}, time);
    if (const RenderedPicture* newest = s.renderer.newest(); newest && newest != s.shown)
        s.take(*newest);
    if (const HoleAnswer* answer = s.renderer.takeHoles()) {
        s.warp.answer(*answer);
        s.changing = s.fadeFrames + 1;
    }
    if (std::optional<HoleRequest> request = s.warp.takeRequest()) {
        request->source = s.scene;
        s.renderer.requestHoles(*request);
    }
}

bool TracedLayer::isStale() const {
    return state_->changing > 0 || state_->isMoving();
}

LayerPicture& TracedLayer::render(const RigidTransform& T_world_video) {
    if (state_->changing > 0) --state_->changing;
    const State& s = *state_;
    return state_->warp.run(T_world_video, s.isMoving() ? posesAt(*s.scene, s.time)
                                                        : std::vector<RigidTransform>());
}

bool TracedLayer::rests() const {
    return state_->renderer.rests();
}

TracedLayerCounters TracedLayer::counters() const {
    const WarpCounters& warp = state_->warp.counters();
    return {state_->renderer.counters(),
            warp.warped,
            warp.unmoved,
            warp.requested,
            warp.answered,
            warp.openHoles};
}

std::optional<std::string> TracedLayer::takeError() {
    return state_->renderer.takeError();
}

}  // namespace mfar
