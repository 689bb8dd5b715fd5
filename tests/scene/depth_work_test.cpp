#include "hal/gl_context.h"
#include "tests/measure/eval/scene_run.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

namespace mfar::test {
namespace {

using namespace eval;

class DepthWork : public testing::Test {
protected:
    DepthWork() {
        context_->makeCurrent();
        SyntheticOptions options;
        options.scene = synthetic::Scene::Office;
        options.path = synthetic::Path::Handheld;
        scene_.emplace(options, PoseSource::Recorded);
        pipeline_.emplace(scene_->rig(), PipelineOptions{});
    }

    /// Places a sphere with a diameter of 10 cm in front of the camera's first position, at the
    /// share `share` of the distance to the desk.
    void placeSphere(double share) {
        VirtualObject sphere;
        sphere.shape = VirtualShape::Sphere;
        sphere.size.setConstant(0.1);
        const RigidTransform& T = scene_->board().pose({}).T_world_video;
        sphere.T_world_object.translation = T * Eigen::Vector3d(0, 0, share * kDesk);
        pipeline_->setObjects({sphere});
    }

    std::vector<FrameStats> run(int frames) {
        std::vector<FrameStats> out;
        for (int i = 0; i < frames; ++i) {
            const SceneRun::Shots shots = scene_->next();
            if (count_++ == 0) scene_->fire();
            out.push_back(runOn(*pipeline_, shots).stats);
        }
        return out;
    }

    static constexpr double kDesk = 0.8;

private:
    std::unique_ptr<GlContext> context_ = createGlContext();
    std::optional<SceneRun> scene_;
    std::optional<Pipeline> pipeline_;
    int count_ = 0;
};

TEST_F(DepthWork, DepthBehindAnObjectIsMeasuredPeriodically) {
    placeSphere(0.5);
    run(6);
    int measured = 0, skipped = 0;
    for (const FrameStats& stats : run(10)) {
        if (stats.depthTiles > 0)
            ++measured;
        else
            EXPECT_GT(stats.depthTilesSkipped, 0);
        if (stats.depthTilesSkipped > 0) ++skipped;
    }
    EXPECT_GE(measured, 1);
    EXPECT_GE(skipped, 8);
}

TEST_F(DepthWork, PossibleOccludersAreMeasuredInEveryFrame) {
    placeSphere(1.0);
    run(6);
    for (const FrameStats& stats : run(3))
        EXPECT_GT(stats.depthTiles, 0);
}

TEST_F(DepthWork, AnOccludedObjectIsNotDrawnButDepthKeepsBeingMeasured) {
    placeSphere(1.5);
    run(6);
    for (const FrameStats& stats : run(4)) {
        EXPECT_TRUE(stats.objectsInView);
        EXPECT_TRUE(stats.objectsHidden);
        EXPECT_GT(stats.depthTiles, 0);
    }
    placeSphere(0.5);
    run(2);
    for (const FrameStats& stats : run(2))
        EXPECT_FALSE(stats.objectsHidden);
}

}  // namespace
}  // namespace mfar::test
