#include "tests/measure/eval/occlusion.h"

#include "daemon/config.h"
#include "hal/gl_context.h"
#include "tests/measure/eval/metrics/occlusion_score.h"
#include "tests/measure/eval/scene_objects.h"
#include "tests/measure/eval/scene_run.h"
#include "tests/measure/eval/virtual_truth.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

namespace mfar::eval {
namespace {

using synthetic::Path;

/// The first frames are not scored, because the first still must arrive and depth must settle.
constexpr int kSettling = 8;

std::optional<double> measured(double value) {
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

double msOf(const Pipeline& pipeline, std::string_view stage) {
    double sum = 0;
    for (const StageTime& time : pipeline.stageTimes())
        if (time.stage == stage) sum += time.ms;
    return sum;
}

std::string_view nameOf(VirtualShape shape) {
    switch (shape) {
    case VirtualShape::Box: return "box";
    case VirtualShape::Sphere: return "sphere";
    case VirtualShape::Quad: return "quad";
    }
    return "";
}

struct Placement {
    std::string label;
    synthetic::Scene scene;
    Path path;
    VirtualObject object;
};

class PlacementRun {
public:
    PlacementRun(const OcclusionRequest& request, Placement placement)
        : request_(request), placement_(std::move(placement)),
          scene_(boardOptions(), request.poses), pipeline_(scene_.rig(), {}) {
        pipeline_.setMeasure(true);
        pipeline_.setObjects({placement_.object});
    }

    void run(Report& report, const ProgressPart& progress) {
        const int all = kSettling + request_.frames;
        cv::Mat before;
        for (int frame = 0; frame < all; ++frame) {
            progress.show(static_cast<std::size_t>(frame), static_cast<std::size_t>(all), "");
            const SceneRun::Shots shots = scene_.next();
            if (frame == 0) scene_.fire();
            runOn(pipeline_, shots);
            if (frame + 1 < kSettling) continue;
            const cv::Mat shown = shownObjects(pipeline_);
            if (frame >= kSettling) score(report, shots.frame.time(), before, shown);
            before = shown;
        }
    }

private:
    [[nodiscard]] SyntheticOptions boardOptions() const {
        SyntheticOptions out;
        out.scene = placement_.scene;
        out.path = placement_.path;
        out.noise = request_.noise;
        return out;
    }

    void score(Report& report, Timestamp time, const cv::Mat& before, const cv::Mat& shown) const {
        const SyntheticBoard& board = scene_.board();
        const CameraModel& video = board.rig().video;
        const VirtualTruth truth =
            virtualTruth(std::span(&placement_.object, 1), video, board.pose(time).T_world_video,
                         board.inverseDepth(time));
        const OcclusionScore got = occlusionScore(shownAtVideo(shown, video.size), truth.visible);
        const double scale = static_cast<double>(shown.total()) / truth.visible.total();
        std::optional<double> flickering;
        if (placement_.path == Path::Rest)
            flickering =
                measured(flicker(before, shown, scale * cv::countNonZero(truth.silhouette)));
        report.add(placement_.label, std::to_string(time.ns),
                   request_.poses == PoseSource::Tags ? "tags" : "recorded",
                   {msOf(pipeline_, "depth"), msOf(pipeline_, "objects"), measured(got.overlap),
                    measured(got.boundary), flickering});
    }

    const OcclusionRequest& request_;
    Placement placement_;
    SceneRun scene_;
    Pipeline pipeline_;
};

std::vector<VirtualObject> objectsFor(const OcclusionRequest& request, synthetic::Scene scene) {
    const auto out = request.objects.empty()
                         ? sceneObjects(scene)
                         : placedShapes(loadConfig(request.objects).objects, {});
    if (out.empty() && request.objects.empty())
        throw EvalError(fmt::format(
            "mfar-eval has no objects for scene {}; name a configuration file with --objects",
            synthetic::name(scene)));
    if (out.empty())
        throw EvalError(fmt::format("{}: the file has no [[objects]]", request.objects.string()));
    return out;
}

}  // namespace

Report evaluateOcclusion(const OcclusionRequest& request) {
    if (request.poses == PoseSource::None)
        throw EvalError(
            "--poses none: without poses no object is shown; use --poses recorded or tags");
    Report report(
        {{"depth_ms", 2}, {"composite_ms", 2}, {"iou", 4}, {"boundary_px", 3}, {"flicker", 6}});
    const auto context = createGlContext();
    const std::size_t scenes = request.scenes.size(), paths = request.paths.size();
    for (std::size_t s = 0; s < scenes; ++s) {
        const synthetic::Scene scene = request.scenes[s];
        const auto objects = objectsFor(request, scene);
        for (std::size_t p = 0; p < paths; ++p) {
            const Path path = request.paths[p];
            const ProgressPart progress = request.progress.part(s * paths + p, scenes * paths, "");
            for (std::size_t i = 0; i < objects.size(); ++i) {
                context->makeCurrent();
                const std::string label =
                    fmt::format("{}/{}/{}-{}", synthetic::name(scene), synthetic::name(path),
                                nameOf(objects[i].shape), i + 1);
                PlacementRun(request, {label, scene, path, objects[i]})
                    .run(report, progress.part(i, objects.size(), label));
            }
        }
    }
    report.addMeans();
    report.addMedians();
    return report;
}

}  // namespace mfar::eval
