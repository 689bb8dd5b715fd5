// Member functions of Pipeline that handle real depth and virtual objects.

#include "pipeline/engine_trial.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/pipeline_state.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace mfar {
namespace {

int tilesIn(const PixelRect& videoPixels) {
    return static_cast<int>(tilesAround(videoPixels).area());
}

}  // namespace

void Pipeline::State::needDepth() {
    if (!depth) depth.emplace(rig.video, workers, options.depth);
}

void Pipeline::setObjects(std::vector<VirtualObject> objects) {
    State& s = *state_;
    s.sceneFollower.reset();
    s.lightFollower.reset();
    if (!s.objects && objects.empty()) return;
    s.needDepth();
    if (!s.objects || s.objects->traced() != nullptr) {
        s.redraw = true;
        s.objects.emplace(s.rig.video, s.output, s.engineOf(s.options.engines.occlusion));
        s.objects->setSkips(s.options.skips);
    }
    s.objects->setObjects(std::move(objects));
}

void Pipeline::setScene(Scene scene, const TracedLayerOptions& options,
                        std::optional<LightFollower> light) {
    State& s = *state_;
    s.sceneFollower.reset();
    s.lightFollower = std::move(light);
    s.newLight.reset();
    if (scene.objects.empty()) {
        // Destroys the view. Otherwise, the last picture of the removed objects would be shown
        // until the next scene has its first picture.
        s.redraw = s.redraw || s.objects.has_value();
        s.objects.reset();
        s.plan.drawnOver({}, WorkPlan::Redraw::WithThem);
        return;
    }
    s.needDepth();
    TracedLayerOptions wanted = options;
    if (wanted.size.width <= 0 || wanted.size.height <= 0)
        wanted.size = {(s.output.width + 1) / 2, (s.output.height + 1) / 2};
    if (s.options.engines.occlusion == EngineKind::Gles) wanted.size = layerOnGpu(wanted.size);
    if (!s.objects || s.objects->traced() == nullptr || !(s.traced == wanted)) {
        s.redraw = true;
        s.objects.emplace(s.rig.video, s.engineOf(s.options.engines.occlusion), wanted);
        s.objects->setSkips(s.options.skips);
        s.traced = wanted;
    }
    s.objects->setScene(s.sceneFollower.emplace().set(std::move(scene)));
}

void Pipeline::State::followScene(const VideoFrame& frame, const std::optional<Pose>& pose,
                                  Timestamp time) {
    if (!sceneFollower || !pose) return;
    const RigidTransform& T_world_video = pose->T_world_video;
    // Light is learned from all frames. Frames without virtual objects may be the only ones that
    // show the lamps.
    if (lightFollower)
        if (auto light = lightFollower->follow(frame.view, rig.video, T_world_video, time))
            newLight = std::move(light);
    if (!inView()) return;
    const SceneFollower::RealDepth real{depth->snap.field(), depth->snap.where(), rig.video,
                                        T_world_video, time};
    if (auto scene = sceneFollower->follow(real, objects->region()))
        objects->setScene(std::move(scene));
    if (newLight) objects->setScene(sceneFollower->relight(*std::exchange(newLight, {})));
}

PixelRect Pipeline::objectsRegion() const {
    return state_->objects ? state_->objects->region() : PixelRect{};
}

std::optional<TracedLayerCounters> Pipeline::tracedCounters() const {
    if (!state_->objects || state_->objects->traced() == nullptr) return {};
    return state_->objects->traced()->counters();
}

std::optional<std::string> Pipeline::takeSceneError() {
    if (!state_->objects || state_->objects->traced() == nullptr) return {};
    return state_->objects->traced()->takeError();
}

void Pipeline::waitForTracer(std::chrono::milliseconds most) const {
    if (!state_->objects || state_->objects->traced() == nullptr) return;
    const auto end = std::chrono::steady_clock::now() + most;
    while (!state_->objects->traced()->rests() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::microseconds(200));
}

const InverseDepthField& Pipeline::inverseDepth() const {
    return state_->depth.value().snap.field();
}

PixelRect Pipeline::State::placeObjects(const std::optional<Pose>& pose, Timestamp time) {
    PixelRect where;
    if (objects) {
        where = objects->place(pose ? std::optional(pose->T_world_video) : std::nullopt, time,
                               depth->stage.field());
        // If detail and occlusion run on different engines, each engine has its own copy of the
        // picture. When the detail step draws a tile, the whole picture is copied to the other
        // engine, where it overwrites all objects that were drawn there before.
        const bool apart = options.engines.detail != options.engines.occlusion;
        const WorkPlan::Redraw redrawn = objects->redraw();
        plan.drawnOver(objects->staleTiles(), apart && redrawn == WorkPlan::Redraw::WithThem
                                                  ? WorkPlan::Redraw::WithOthers
                                                  : redrawn);
    }
    if (options.depthEverywhere) where = {0, 0, rig.video.size.width, rig.video.size.height};
    return where;
}

Pipeline::State::DepthTask Pipeline::State::prepareDepth(const PixelRect& where, bool hasPose,
                                                         const FlowCells* alongLines) {
    DepthTask task;
    task.where = where;
    const bool isNeeded = options.depthEverywhere ? plan.work().changed > 0 : drawsObjects();
    task.measures = hasPose && isNeeded && (!where.empty() || inView());
    task.isDue = task.measures && ++depthAge >= quality.depthEvery && !where.empty();
    if (!task.isDue) return task;
    depthAge = 0;
    if (alongLines != nullptr) {
        task.matches.emplace();
        task.matches->vectors.resize(alongLines->count());
        std::memcpy(task.matches->vectors.data(), alongLines->cells.host().data,
                    sizeof(FlowCell) * alongLines->count());
        task.matches->searched2d = newest.flow->searchedTiles();
    }
    return task;
}

void Pipeline::State::measureDepth(const VideoFrame& frame, Timestamp time, Pose pose,
                                   const DepthTask& task) {
    pose.time = time;
    const PixelRect& where = task.where;
    if (task.matches) {
        const DepthStage::StillSearch search{epipolar->search(), epipolar->rotation(),
                                             epipolar->unit(), epipolar->lengthError(),
                                             epipolar->sOf(task.matches->vectors)};
        depth->stage.run(epipolar->luma(), pose, search, where);
        forgetMoving(*task.matches);
    } else {
        lumaOf(frame.view, depth->luma);
        depth->stage.run(depth->luma, pose, {}, task.isDue ? where : PixelRect{});
    }
    depth->snap.run(depth->stage.field(), frame.view, where);
    result.stats.depthTiles = tilesIn(where);
    if (inView())
        result.stats.depthTilesSkipped = std::max(tilesIn(objects->region()) - tilesIn(where), 0);
    if (!where.empty()) result.stats.depth = depth->stage.source();
    lap("depth");
}

// Forgets the depth of moving things. They are found as tiles whose flow leaves the epipolar lines.
void Pipeline::State::forgetMoving(const DepthMatches& matches) {
    const Size tiles = plan.tileCount();
    for (int t = 0; t < tiles.width * tiles.height; ++t) {
        if (!matches.searched2d[static_cast<std::size_t>(t)]) continue;
        const int x = t % tiles.width, y = t / tiles.width;
        const PixelRect tile = pixelsOf({x, y, x + 1, y + 1});
        if (leavesLines(tile, matches.vectors)) depth->stage.forget(tile);
    }
}

// True if at least a quarter of the tile's cells have a flow that leaves the epipolar lines.
bool Pipeline::State::leavesLines(const PixelRect& tile, const EpipolarFlow::Cells& vectors) const {
    const int columns = cellsOf(rig.video.size).width;
    int off = 0, all = 0;
    for (int y = tile.y0 + 1; y < tile.y1; y += kCell) {
        for (int x = tile.x0 + 1; x < tile.x1; x += kCell, ++all) {
            const auto& u = vectors[static_cast<std::size_t>(y / kCell) * columns + x / kCell];
            if (epipolar->offLine(x, y, u[0], u[1]) > kOffLine) ++off;
        }
    }
    return all > 0 && 4 * off >= all;
}

void Pipeline::State::showObjects(const VideoFrame& frame) {
    result.stats.objectsInView = inView();
    result.stats.objectsHidden = inView() && objects->isHidden();
    if (!drawsObjects()) return;
    objects->draw(depth->snap.field(), depth->snap.where(), frame, detail->output());
    lap("objects");
}

}  // namespace mfar
