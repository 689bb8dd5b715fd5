#include "hal/gl_context.h"
#include "tests/measure/eval/metrics/occlusion_score.h"
#include "tests/measure/eval/scene_objects.h"
#include "tests/measure/eval/scene_run.h"
#include "tests/measure/eval/virtual_truth.h"
#include "tests/scene/stopped_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

namespace mfar::test {
namespace {

using namespace eval;
using synthetic::Path;

constexpr int kUnscored = 8;

/// Limits for each scene. The shelf needs less overlap than the office, because its objects are
/// thin. The depth search compares neighbourhoods of pixels and so makes objects wider. EdgeSnap
/// corrects only a part of this.
struct Case {
    synthetic::Scene scene;
    double leastOverlap, mostBoundary;  // limits of IoU and of mean boundary distance [px]
};

class Occlusion : public testing::TestWithParam<Case> {
protected:
    void SetUp() override { context_->makeCurrent(); }

    [[nodiscard]] static SceneRun sceneOn(Path path) {
        SyntheticOptions options;
        options.scene = GetParam().scene;
        options.path = path;
        return {options, PoseSource::Recorded};
    }

    const VirtualObject object_ = sceneObjects(GetParam().scene).at(0);

    [[nodiscard]] VirtualTruth truthAt(const SyntheticBoard& board, Timestamp time) const {
        return virtualTruth(std::span(&object_, 1), board.rig().video,
                            board.pose(time).T_world_video, board.inverseDepth(time));
    }

private:
    std::unique_ptr<GlContext> context_ = createGlContext();
};

TEST_P(Occlusion, RealObjectsOccludeAVirtualOneUpToTheirEdges) {
    SceneRun scene = sceneOn(Path::Handheld);
    Pipeline pipeline(scene.rig(), {});
    pipeline.setObjects({object_});
    double overlap = 0, boundary = 0;
    int scored = 0;
    for (int frame = 0; frame < 2 * kUnscored; ++frame) {
        const SceneRun::Shots shots = scene.next();
        if (frame == 0) scene.fire();
        runOn(pipeline, shots);
        if (frame < kUnscored) continue;
        const OcclusionScore score =
            occlusionScore(shownAtVideo(shownObjects(pipeline), scene.rig().video.size),
                           truthAt(scene.board(), shots.frame.time()).visible);
        overlap += score.overlap;
        boundary += score.boundary;
        ++scored;
    }
    RecordProperty("overlap", std::to_string(overlap / scored));
    RecordProperty("boundary", std::to_string(boundary / scored));
    EXPECT_GT(overlap / scored, GetParam().leastOverlap);
    EXPECT_LT(boundary / scored, GetParam().mostBoundary);
}

class Rest : public Occlusion {};

/// Intersection over union of the object's truly visible part and the part that a pipeline shows.
double overlapOf(const Pipeline& pipeline, const VirtualTruth& truth) {
    return occlusionScore(
               shownAtVideo(shownObjects(pipeline), {truth.visible.cols, truth.visible.rows}),
               truth.visible)
        .overlap;
}

TEST_P(Rest, OneStillIsEnoughForOcclusion) {
    SceneRun scene = sceneOn(Path::Rest);
    Pipeline pipeline(scene.rig(), {});
    pipeline.setObjects({object_});
    for (int frame = 0; frame < kUnscored; ++frame) {
        const SceneRun::Shots shots = scene.next();
        if (frame == 0) scene.fire();
        runOn(pipeline, shots);
    }
    EXPECT_GT(overlapOf(pipeline, truthAt(scene.board(), scene.board().epoch())),
              GetParam().leastOverlap);
}

// The camera is carried by hand and then put down at the position of the scene's resting camera.
TEST_P(Rest, OcclusionNeitherFlickersNorDegradesAtRest) {
    constexpr int kFrames = 30;
    constexpr double kMostFlicker = 0.001;
    SceneRun carried = sceneOn(Path::Handheld), resting = sceneOn(Path::Rest);
    Pipeline pipeline(carried.rig(), {});
    pipeline.setObjects({object_});
    const SceneRun::Shots rest = resting.next();
    Pose pose = *rest.pose;
    for (int frame = 0; frame < 2 * kUnscored; ++frame) {
        const SceneRun::Shots shots = carried.next();
        if (frame == 0) carried.fire();
        runOn(pipeline, shots);
        pose.time = shots.frame.time();
    }
    StoppedCamera stopped(resting.board(), rest.frame);
    const VirtualTruth truth = truthAt(resting.board(), rest.frame.time());
    const double scale = static_cast<double>(pipeline.outputSize().width) / truth.visible.cols;
    const double silhouette = scale * scale * cv::countNonZero(truth.silhouette);
    const auto next = [&](std::int64_t step) {
        pose.time.ns += step;
        pipeline.run(stopped.next(), pose.time, pose);
    };
    for (int frame = 0; frame < kUnscored; ++frame)
        next(33'333'333);
    const double overlap = overlapOf(pipeline, truth);
    cv::Mat before = shownObjects(pipeline);
    double worst = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        next(33'333'333);
        const cv::Mat shown = shownObjects(pipeline);
        worst = std::max(worst, flicker(before, shown, silhouette));
        before = shown;
    }
    EXPECT_LT(worst, kMostFlicker);
    for (int frame = 0; frame < kFrames; ++frame)
        next(300'000'000);
    EXPECT_GT(overlapOf(pipeline, truth), overlap - 0.01);
}

std::string nameOf(const testing::TestParamInfo<Case>& c) {
    return c.param.scene == synthetic::Scene::Office ? "Office" : "Shelf";
}

const auto kCases = testing::Values(Case{synthetic::Scene::Office, 0.95, 1.5},
                                    Case{synthetic::Scene::Shelf, 0.9, 1.5});
INSTANTIATE_TEST_SUITE_P(Scenes, Occlusion, kCases, nameOf);
INSTANTIATE_TEST_SUITE_P(Scenes, Rest, kCases, nameOf);

}  // namespace
}  // namespace mfar::test
