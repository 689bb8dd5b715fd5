// Real depth is measured only where it may decide about a virtual object.
#include "hal/gl_context.h"
#include "hal/virtual/synthetic_board.h"
#include "pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

namespace mfar::test {
namespace {

using namespace std::chrono_literals;

class DepthWork : public testing::Test {
protected:
    DepthWork() {
        context_->makeCurrent();
        SyntheticOptions options;
        options.scene = synthetic::Scene::Office;
        options.path = synthetic::Path::Handheld;
        options.pace = Pace::Consumer;
        board_.emplace(options);
        board_->video().start();
        board_->stills().start();
        pipeline_.emplace(board_->rig(), PipelineOptions{});
    }

    /// A sphere of 10 cm before the camera's first place, at this share of the way to the desk.
    void placeSphere(double share) {
        VirtualObject sphere;
        sphere.shape = VirtualShape::Sphere;
        sphere.size.setConstant(0.1);
        const RigidTransform& T = board_->pose({}).T_world_video;
        sphere.T_world_object.translation = T * Eigen::Vector3d(0, 0, share * kDesk);
        pipeline_->setObjects({sphere});
    }

    std::vector<FrameStats> run(int frames) {
        std::vector<FrameStats> out;
        for (int i = 0; i < frames; ++i) {
            const auto video = board_->video().next(60s);
            if (!video) break;
            if (count_++ == 0) board_->trigger().fire();
            if (const auto still = board_->stills().next(0s))
                pipeline_->setStill(still->view(), still->time(), board_->pose(still->time()));
            out.push_back(
                pipeline_->run(video->view(), video->time(), board_->pose(video->time())).stats);
        }
        return out;
    }

    static constexpr double kDesk = 0.8;  // [m]

private:
    std::unique_ptr<GlContext> context_ = createGlContext();
    std::optional<SyntheticBoard> board_;
    std::optional<Pipeline> pipeline_;
    int count_ = 0;
};

TEST_F(DepthWork, WhatLiesBehindAnObjectIsLookedAtNowAndThen) {
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

TEST_F(DepthWork, WhatMayHideItIsMeasuredInEveryFrame) {
    placeSphere(1.0);
    run(6);
    for (const FrameStats& stats : run(3))
        EXPECT_GT(stats.depthTiles, 0);
}

}  // namespace
}  // namespace mfar::test
