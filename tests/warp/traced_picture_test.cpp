#include "pipeline/composite/virtual_layer.h"
#include "pipeline/scene/rigid_path.h"
#include "pipeline/warp/traced_picture.h"
#include "tests/warp/cast_scene.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

namespace mfar {
namespace {

/// A picture of 5x4 pixels. Object 1 covers the left three columns in front of the shadow catcher.
RenderedPicture smallPicture() {
    RenderedPicture p;
    p.camera = {{5, 4}, 5, 5, 2, 1.5, {}};
    for (int i = 0; i < 20; ++i) {
        const bool object = i % 5 < 3, edge = i % 5 == 2;
        p.id.push_back(object ? 1 : kCatcherId);
        p.depth.push_back(object ? 0.5F : 0.8F);
        p.colour.push_back(edge     ? std::array<std::uint8_t, 4>{50, 0, 0, 160}
                           : object ? std::array<std::uint8_t, 4>{200, 100, 0, 255}
                                    : std::array<std::uint8_t, 4>{0, 0, 0, 60});
    }
    return p;
}

TEST(TracedPicture, EdgePixelsGetTheColourOfTheirObject) {
    const TracedPicture r = tracedPicture(smallPicture());
    for (std::size_t i = 0; i < 20; ++i) {
        const std::array<std::uint8_t, 4> object{200, 100, 0, 255}, shadow{0, 0, 0, 60};
        EXPECT_EQ(r.colour[i], i % 5 < 3 ? object : shadow) << i;
        EXPECT_EQ(r.surface[i].known, 1) << i;
    }
    EXPECT_EQ(r.picture, smallPicture().colour);
}

TEST(TracedPicture, PixelsOfALayeredPictureKeepTheirColourAndLight) {
    RenderedPicture p = smallPicture();
    p.layered = true;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto shade = static_cast<std::uint8_t>(10 * i);
        p.colour[i] = {shade, shade, shade, 255};
        p.light.push_back(packedWords({{static_cast<float>(i), 0, 0}, {}, 0}));
    }
    const TracedPicture r = tracedPicture(p);
    EXPECT_EQ(r.colour, p.colour);
    EXPECT_EQ(r.light, p.light);
    EXPECT_TRUE(r.layered);
}

TEST(TracedPicture, GlossOfMovingObjectsIsUnknownAndTheListOfGlossIsEmptyIfAllObjectsMove) {
    RenderedPicture p = smallPicture();
    for (std::size_t i = 0; i < 20; ++i) {
        if (i / 5 < 2 && p.id[i] == 1) p.id[i] = 2;
        p.gloss.push_back(p.id[i] == kCatcherId ? GlossWords{}
                                                : packedGloss({0, 0, 1}, 0.5F, 0.04F, 1));
    }
    for (int moving = 0; moving < 3; ++moving) {
        auto scene = std::make_shared<Scene>();
        scene->objects.resize(2);
        for (int i = 0; i < moving; ++i)
            scene->objects[static_cast<std::size_t>(i)].path = std::make_shared<const RigidPath>();
        p.scene = scene;
        p.poses.resize(2);
        const TracedPicture r = tracedPicture(p);
        ASSERT_EQ(r.gloss.empty(), moving == 2);
        for (std::size_t i = 0; i < r.gloss.size(); ++i)
            EXPECT_EQ(r.gloss[i] == GlossWords{}, p.id[i] <= moving || p.id[i] == kCatcherId) << i;
    }
}

TEST(TracedPicture, ShadowsAreShownAboveTheSurfaceButMoveWithTheSurface) {
    const RenderedPicture p = smallPicture();
    const TracedPicture r = tracedPicture(p);
    for (std::size_t i = 0; i < 20; ++i) {
        const bool object = i % 5 < 3;
        EXPECT_FLOAT_EQ(r.depth[i], object ? 0.5F : 0.8F * (1 - kShadowLift)) << i;
        EXPECT_EQ(r.surface[i].z, p.depth[i]) << i;
    }
    EXPECT_EQ(r.tiles.at(0).farthest, 0.8F);
}

TEST(TracedPicture, PixelsWithInvalidDepthAreEmpty) {
    RenderedPicture p = smallPicture();
    p.depth[0] = std::numeric_limits<float>::quiet_NaN();
    p.depth[1] = std::numeric_limits<float>::infinity();
    p.depth[5] = -1;
    p.depth[6] = 0.001F;
    p.id[10] = 0;
    const TracedPicture r = tracedPicture(p);
    for (const std::size_t i : {0, 1, 5, 6, 10}) {
        EXPECT_EQ(r.depth[i], 0);
        EXPECT_EQ(r.packed[i], 0U);
        EXPECT_EQ(r.colour[i], (std::array<std::uint8_t, 4>{}));
    }
}

TEST(TracedPicture, InvalidPicturesAreRefused) {
    const auto refused = [](auto&& spoil) {
        RenderedPicture p = smallPicture();
        spoil(p);
        EXPECT_THROW((void)tracedPicture(p), std::invalid_argument);
    };
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    refused([](RenderedPicture& p) { p.depth.pop_back(); });
    refused([](RenderedPicture& p) { p.id.push_back(0); });
    refused([](RenderedPicture& p) { p.colour.clear(); });
    refused([](RenderedPicture& p) { p.camera.size = {0, 4}; });
    refused([](RenderedPicture& p) { p.camera.size = {20000, 1}; });
    refused([&](RenderedPicture& p) { p.camera.fx = kNan; });
    refused([](RenderedPicture& p) { p.camera.fy = 0; });
    refused([&](RenderedPicture& p) { p.camera.distortion[2] = kNan; });
    refused([&](RenderedPicture& p) { p.T_world_camera.translation.x() = kNan; });
}

TEST(TracedPicture, BoundsOfTheMotionContainEveryMovedPoint) {
    const test::CastScene scene = test::twoBalls();
    const RenderView view{test::bentCamera({160, 120}), test::orbit(0)};
    const RenderedPicture picture = scene.cast(view);
    const TracedPicture r = tracedPicture(picture);
    const LensProjection lens(view.camera);
    EXPECT_LT(motionOf(r, lens, test::orbit(0)).greatest, 1e-6);
    for (const double degrees : {1.0, 10.0, 60.0}) {
        const WarpMotion motion = motionOf(r, lens, test::orbit(degrees));
        const RigidTransform T = test::orbit(degrees).inverse() * test::orbit(0);
        for (std::size_t i = 0; i < picture.id.size(); ++i) {
            if (picture.id[i] == 0) continue;
            const Eigen::Vector2d at(i % 160, i / 160);
            const Eigen::Vector3d h =
                lens(T * (picture.depth[i] * view.camera.unproject(at).homogeneous()));
            if (!(h.z() > LensProjection::kNear)) continue;
            const Eigen::Vector2d to = h.hnormalized();
            EXPECT_LE((to - at).norm(), motion.greatest + 1e-3);
            if (to.x() < 0 || to.y() < 0 || to.x() > 159 || to.y() > 119) continue;
            EXPECT_TRUE(to.x() >= motion.bounds.x0 && to.x() < motion.bounds.x1 &&
                        to.y() >= motion.bounds.y0 && to.y() < motion.bounds.y1)
                << degrees << " " << to.transpose();
        }
    }
    RigidTransform away = test::orbit(0);
    away.rotation = away.rotation * Eigen::Quaterniond(0, 0, 1, 0);
    EXPECT_TRUE(motionOf(r, lens, away).bounds.empty());
}

}  // namespace
}  // namespace mfar
