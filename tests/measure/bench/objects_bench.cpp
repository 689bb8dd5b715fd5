#include "tests/measure/bench/objects_bench.h"

#include "daemon/virtual_world.h"
#include "pipeline/models/showpiece.h"
#include "pipeline/scene/scene_bounds.h"
#include "tests/measure/bench/pipeline_run.h"
#include "tests/measure/eval/report.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace mfar::bench {
namespace {

constexpr std::chrono::microseconds kPeriod{33'333};
// Height of the model's bounds in the first frame / height of the frame.
constexpr double kFill = 0.5;
constexpr int kWarmUpPasses = 1, kPasses = 3;
constexpr int kMostWarmUpFrames = 3000;

/// Returns the scene with the showpiece in the middle of this camera's picture.
Scene sceneBefore(const CameraModel& camera, const RigidTransform& T_world_camera) {
    PlacedObject object;
    object.model = std::make_shared<const Model>(showpiece());
    Scene scene = sceneOf({object}, {}, {});
    const Eigen::AlignedBox3d box = boundsOf(scene);
    const double distance = camera.fy * box.sizes().z() / (kFill * camera.size.height);
    const Eigen::Vector3d shift =
        T_world_camera * Eigen::Vector3d(0, 0, distance) - Eigen::Vector3d(box.center());
    for (SceneObject& part : scene.objects) {
        part.T_world_object.translation += shift;
        part.T_world_ground.translation += shift;
    }
    return scene;
}

/// Returns options with which all frames show a picture of the first frame's view. If pictures were
/// replaced during the measurement, the frame times with and without work could not be compared: an
/// older picture has more holes, and filling them takes time. With `works`, the path tracer adds
/// samples to this picture in every frame.
TracedLayerOptions optionsFor(Size output, bool works) {
    TracedLayerOptions out = tracedLayerOptions(VirtualOptions{}, 1);
    out.size = layerSize(VirtualOptions{}, output, output);
    out.renderer.slices.samples = works ? 65536 : 4;
    out.renderer.policy.limits = {.turnDegrees = 1e6, .zoom = 1e6};
    out.warp.filling = HoleFilling::PushPull;
    return out;
}

/// Shows the first frame until there is a picture and, with `idle`, the path tracer has no work.
void waitForPicture(PipelineRun& run, bool idle) {
    for (int frame = 0; frame < kMostWarmUpFrames; ++frame) {
        run.run(0);
        run.pipeline().waitForTracer(std::chrono::seconds(1));
        const auto counters = run.pipeline().tracedCounters();
        if (counters && counters->render.shown > 0 && (!idle || counters->render.idle)) return;
    }
    throw eval::EvalError("objects: the path tracer does not finish its first picture");
}

}  // namespace

ObjectTimes measureObjects(const Workload& posed, EngineKind engine, const ProgressPart& progress) {
    if (!TracedLayer::isAvailable() || posed.framePoses.empty() || !posed.framePoses[0]) return {};
    PipelineRun tracing(posed, SuperResMode::Detail, engine),
        waiting(posed, SuperResMode::Detail, engine);
    const Scene scene = sceneBefore(posed.rig.video, posed.framePoses[0]->T_world_video);
    const Size output = tracing.pipeline().outputSize();
    tracing.pipeline().setScene(scene, optionsFor(output, true));
    waiting.pipeline().setScene(scene, optionsFor(output, false));
    waitForPicture(tracing, false);
    waitForPicture(waiting, true);
    std::vector<double> tracingMs, waitingMs;
    auto next = std::chrono::steady_clock::now();
    const auto paced = [&next](PipelineRun& run, std::size_t frame) {
        const double ms = run.run(frame);
        next = std::max(next + kPeriod, std::chrono::steady_clock::now());
        std::this_thread::sleep_until(next);
        return ms;
    };
    // Every second pass runs backwards, so that the view never jumps. A pass leaves out its last
    // frame, with which the next pass begins.
    const std::size_t last = posed.frames.size() - 1, pass = std::max(last, std::size_t{1});
    const std::size_t all = pass * (kWarmUpPasses + kPasses);
    for (std::size_t i = 0; i < all; ++i) {
        progress.show(i, all, "");
        const std::size_t at = i % pass, frame = i / pass % 2 == 0 ? at : last - at;
        const double with = paced(tracing, frame), without = paced(waiting, frame);
        if (i < pass * kWarmUpPasses) continue;
        tracingMs.push_back(with);
        waitingMs.push_back(without);
    }
    return {summarise(std::move(tracingMs)), summarise(std::move(waitingMs))};
}

}  // namespace mfar::bench
