#include "pipeline/epipolar/two_way.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

using test::motion;
using test::View;

/// Shares of the pixels that both cameras see, and of those behind the panel for the still's, whose
/// error is above one pixel.
struct Shares {
    double seen, hidden;
};

Shares sharesOf(const View& view) {
    const CameraModel& camera = view.camera;
    EpipolarSearch forward = test::searchWith(camera, 2);
    forward.setStill(test::viewOf(view.still()));
    const LumaImage video = view.video();
    EXPECT_TRUE(forward.run(video, view.T_still_video));
    TwoWayTest test({camera, camera, {}}, std::make_shared<Workers>(2), {});
    test.run(forward, test::viewOf(video));
    int far[2] = {}, all[2] = {};
    for (int y = 8; y < camera.size.height - 8; ++y) {
        for (int x = 8; x < camera.size.width - 8; ++x) {
            const Eigen::Vector2d ray = camera.unproject({x, y});
            const Eigen::Vector3d p =
                view.T_still_video * (view.scene.depth({}, ray) * ray.homogeneous());
            const Eigen::Vector2d there = camera.project(p.hnormalized());
            if (there.minCoeff() < 8 || there.x() > camera.size.width - 9 ||
                there.y() > camera.size.height - 9)
                continue;
            const double before = view.scene.depth(view.T_still_video, p.hnormalized());
            const int hidden = before < 0.98 * p.z() ? 1 : 0;
            const auto i = static_cast<std::size_t>(y) * camera.size.width + x;
            const auto error = test.error(ray, forward.inverseDepth()[i]);
            EXPECT_TRUE(!error || *error >= 0);
            ++all[hidden];
            if (!(error.value_or(1e4F) < 1)) ++far[hidden];
        }
    }
    EXPECT_GT(all[1], 200);
    return {static_cast<double>(far[0]) / all[0], static_cast<double>(far[1]) / all[1]};
}

TEST(TwoWay, OnlyWhatBothPicturesShowComesBack) {
    const CameraModel plain{{200, 150}, 190, 190, 99.5, 74.5, {}};
    const CameraModel barrel{{200, 150}, 160, 161, 103, 72, {-0.29, 0.08, 0.001, -0.0012, 0.002}};
    const test::Scene step{{{{0, 0, 1}, 3}, {{0, 0, 1}, 1.5, {-0.35, -0.4}, {0.3, 0.3}}}, 28, 100};
    for (const View& view : {View{plain, step, motion({0, 0, 0}, {-0.2, 0.02, 0})},
                             View{barrel, step, motion({2, -3, 8}, {0.2, 0.1, 0.05})}}) {
        const Shares shares = sharesOf(view);
        EXPECT_LT(shares.seen, 0.08);
        EXPECT_GT(shares.hidden, 0.8);
    }
}

TEST(TwoWay, WhatTheStillCannotShowHasNone) {
    const CameraModel camera{{64, 48}, 60, 60, 31.5, 23.5, {}};
    const View view{camera, {{{{0, 0, 1}, 2}}, 12, 100}, motion({0, 0, 0}, {0.5, 0, 0})};
    EpipolarSearch forward = test::searchWith(camera, 1);
    forward.setStill(test::viewOf(view.still()));
    const LumaImage video = view.video();
    ASSERT_TRUE(forward.run(video, view.T_still_video));
    TwoWayTest test({camera, camera, {}}, std::make_shared<Workers>(1), {});
    test.run(forward, test::viewOf(video));
    EXPECT_TRUE(test.error(camera.unproject({20, 20}), 0.5));
    EXPECT_FALSE(test.error(camera.unproject({60, 20}), 0.5));
    EXPECT_FALSE(test.error(camera.unproject({20, 20}), std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace mfar
