#include "pipeline/scene/scene_parts.h"
#include "pipeline/traced_layer.h"
#include "tests/engine/gl_test.h"
#include "tests/render/still_life.h"
#include "tests/warp/warp_engine.h"

#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace mfar {
namespace {

using TracedLayerGl = GlTest;

constexpr Size kTraced{96, 72};
constexpr int kBright = 60;  // [grey levels of 255]

/// Options with which a picture from one view is warped to all views. Pixels that the picture does
/// not show are rendered individually, and are empty until then.
TracedLayerOptions rerendering() {
    TracedLayerOptions out;
    out.size = kTraced;
    out.renderer.slices.samples = 16;
    out.renderer.policy.limits = {1e4, 1e4};
    out.renderer.budgetMs = 1000;
    out.warp.filling = HoleFilling::Rerender;
    out.warp.sharpenShare = 0;
    return out;
}

struct Frames {
    /// Shows the next frame with the camera at this azimuth [degrees].
    void show(double azimuth) {
        time = time + std::chrono::milliseconds(33);
        const RigidTransform pose = render_scenes::viewFrom(kTraced, azimuth).T_world_camera;
        layer.update(pose, time);
        rgba = test::bytesOf(layer.render(pose).colour);
    }
    /// Shows frames until `reached` returns true. The azimuth changes by twice `sway` from frame to
    /// frame. Returns false if a minute is not enough.
    [[nodiscard]] bool until(double azimuth, double sway, const std::function<bool()>& reached) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        for (; !reached(); sway = -sway) {
            if (std::chrono::steady_clock::now() > end) return false;
            show(azimuth + sway);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }
    /// Number of pixels in which this channel is bright.
    [[nodiscard]] int brightPixels(std::size_t channel) const {
        int out = 0;
        for (std::size_t i = channel; i < rgba.size(); i += 4)
            out += rgba[i] > kBright ? 1 : 0;
        return out;
    }

    std::unique_ptr<Engine> engine = test::warpEngine();
    TracedLayer layer{render_scenes::viewFrom(kTraced, 0).camera, *engine, rerendering()};
    Timestamp time = Timestamp::fromSeconds(1);
    std::vector<std::uint8_t> rgba;
};

TEST_F(TracedLayerGl, AMovingObjectIsDrawnWhereItIsNow) {
    Frames frames;
    auto scene = std::make_shared<Scene>(*render_scenes::stillLifeLitBy({3, 3, 3}));
    RigidPath path;
    path.length = 200;
    path.joints.resize(1);
    path.joints[0].translation = {MotionTrack::Between::Step,
                                  {0, 100, 200},
                                  {{0, 0, 0.08, 0}, {0.15, -0.25, 0.08, 0}, {0, 0, 0.08, 0}}};
    scene->objects[0].path = std::make_shared<const RigidPath>(path);
    frames.layer.setScene(std::make_shared<const Scene>(sceneAt(*scene, {})));
    ASSERT_TRUE(frames.until(0, 0, [&] { return frames.layer.rests() && !frames.rgba.empty(); }));
    frames.show(0);
    const std::vector<std::uint8_t> before = frames.rgba;
    // The object jumps. The threads cannot have traced a picture of its new position yet.
    frames.time = Timestamp::fromSeconds(100);
    frames.show(0);
    int changed = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        changed += std::abs(int{before[i]} - int{frames.rgba[i]}) > 40 ? 1 : 0;
    EXPECT_GT(changed, 100);
}

TEST_F(TracedLayerGl, NoPixelKeepsTheOldLightIfOnlyTheLightChanges) {
    constexpr double kFront = 0, kAside = 40, kSway = 0.5;
    constexpr std::size_t kRed = 0, kGreen = 1;
    Frames frames;
    frames.layer.setScene(render_scenes::stillLifeLitBy({3, 0, 0}));
    ASSERT_TRUE(frames.until(
        kFront, 0, [&] { return frames.layer.rests() && frames.brightPixels(kRed) > 0; }));
    frames.show(kAside);
    const int open = frames.brightPixels(kRed);
    const auto showsRendered = [&] { return frames.brightPixels(kRed) > open + 30; };
    // If the camera rested here, a picture would be traced from here.
    ASSERT_TRUE(frames.until(kAside, kSway, showsRendered));
    ASSERT_TRUE(frames.until(kFront, 0, [&] { return frames.layer.rests(); }));
    frames.show(kAside);
    EXPECT_TRUE(showsRendered());

    frames.layer.setScene(render_scenes::stillLifeLitBy({0, 3, 0}));
    ASSERT_TRUE(frames.until(kFront, 0, [&] { return frames.brightPixels(kGreen) > 0; }));
    EXPECT_EQ(frames.brightPixels(kRed), 0);
    // Individually rendered pixels can be shown before the first picture with the new light.
    ASSERT_TRUE(frames.until(kFront, 0, [&] { return frames.layer.rests(); }));
    frames.show(kAside);
    EXPECT_GT(frames.brightPixels(kGreen), open / 2);
    EXPECT_EQ(frames.brightPixels(kRed), 0);
}

}  // namespace
}  // namespace mfar
