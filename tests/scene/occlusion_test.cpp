// Virtual objects behind real things of the synthetic scenes, against the truth.
#include "hal/gl_context.h"
#include "tests/eval/metrics/occlusion_score.h"
#include "tests/eval/scene_objects.h"
#include "tests/eval/scene_run.h"
#include "tests/eval/virtual_truth.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace mfar::test {
namespace {

using namespace eval;
using synthetic::Path;
using synthetic::Scene;

constexpr int kSettling = 8;  // frames

/// On the shelf the windows of the matching reach farther beside thin things than the picture's
/// edges put right.
struct Case {
    Scene scene;
    double leastOverlap, mostBoundary;  // [px]
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

TEST_P(Occlusion, RealThingsHideAVirtualOneAtTheirEdges) {
    SceneRun scene = sceneOn(Path::Handheld);
    Pipeline pipeline(scene.rig(), {});
    pipeline.setObjects({object_});
    double overlap = 0, boundary = 0;
    int scored = 0;
    for (int frame = 0; frame < 2 * kSettling; ++frame) {
        const SceneRun::Shots shots = scene.next();
        if (frame == 0) scene.fire();
        runOn(pipeline, shots);
        if (frame < kSettling) continue;
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

std::string nameOf(const testing::TestParamInfo<Case>& c) {
    return c.param.scene == Scene::Office ? "Office" : "Shelf";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Occlusion,
                         testing::Values(Case{Scene::Office, 0.95, 1.5},
                                         Case{Scene::Shelf, 0.9, 2.2}),
                         nameOf);

}  // namespace
}  // namespace mfar::test
