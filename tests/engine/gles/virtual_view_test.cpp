#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/composite/virtual_view.h"
#include "tests/engine/gl_test.h"
#include "tests/warp/warp_engine.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace mfar {
namespace {

constexpr Size kSeen{320, 240};
const CameraModel kAbove{kSeen, 300, 300, 159.5, 119.5, {}};
constexpr double kTable = 0.5;  // distance from the camera to the table [m]

std::shared_ptr<const Scene> hovering() {
    auto model = std::make_shared<Model>();
    model->materials.resize(1);
    model->meshes.resize(1);
    model->meshes[0].positions = {
        {-0.03F, -0.03F, 0.04F}, {0.03F, -0.03F, 0.04F}, {0, 0.03F, 0.07F}};
    model->meshes[0].triangles = {{0, 1, 2}};
    auto scene = std::make_shared<Scene>();
    scene->objects.push_back({model, {}, 1});
    scene->catcher = planeCatcher(boundsOf(*scene));
    // The shadow falls towards +x.
    scene->lighting.sun = Sun{Eigen::Vector3f(-1, 0, 0.8F).normalized(), {3, 3, 3}, 0.01F};
    return scene;
}

/// Depth of the table. `share`: standard deviation of the inverse depth, divided by the inverse
/// depth.
InverseDepthField tableField(double share) {
    InverseDepthField field(kSeen);
    for (std::size_t i = 0; i < field.inverseDepth.size(); ++i) {
        field.inverseDepth[i] = 1 / static_cast<float>(kTable);
        field.variance[i] =
            static_cast<float>(share * share) * field.inverseDepth[i] * field.inverseDepth[i];
    }
    return field;
}

/// Checks, frame by frame, in which area of the picture a camera above the table needs measured
/// depth.
class ShadowDepthGl : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!TracedLayer::isAvailable()) GTEST_SKIP() << "this build has no path tracer";
        engine_ = makeGlesEngine({.rig = {kAbove, kAbove, {}}, .output = kSeen});
        view_ = std::make_unique<VirtualView>(kAbove, *engine_, TracedLayerOptions{.size = kSeen});
        view_->setScene(hovering());
    }
    std::vector<PixelRect> placed(const InverseDepthField& known, int frames = 18) {
        std::vector<PixelRect> out;
        for (int i = 0; i < frames; ++i)
            out.push_back(view_->place(above(0), Timestamp::fromSeconds(i), known));
        return out;
    }
    static RigidTransform above(double x) {
        return {Eigen::Quaterniond(0, 1, 0, 0), {x, 0, kTable}};
    }
    /// Largest alpha of a pixel of the virtual layer, 0 to 255.
    std::uint8_t darkest(const RigidTransform& T_world_video) {
        const std::vector<std::uint8_t> rgba =
            test::bytesOf(view_->traced()->render(T_world_video).colour);
        std::uint8_t out = 0;
        for (std::size_t i = 3; i < rgba.size(); i += 4)
            out = std::max(out, rgba[i]);
        return out;
    }
    [[nodiscard]] VirtualView& view() { return *view_; }
    [[nodiscard]] bool isAll(const PixelRect& r) const { return r == view_->region(); }

private:
    std::unique_ptr<Engine> engine_;
    std::unique_ptr<VirtualView> view_;
};

TEST_F(ShadowDepthGl, DepthUnderShadowsIsMeasuredAgainPeriodically) {
    int all = 0, none = 0;
    for (const PixelRect& r : placed(tableField(0.01))) {
        all += isAll(r) ? 1 : 0;
        none += r.empty() ? 1 : 0;
    }
    EXPECT_EQ(all, 2);
    EXPECT_EQ(none, 16);
}

TEST_F(ShadowDepthGl, UncertainDepthIsAlwaysMeasured) {
    for (const InverseDepthField& field : {tableField(0.03), InverseDepthField(kSeen)})
        for (const PixelRect& r : placed(field))
            EXPECT_TRUE(isAll(r));
}

TEST_F(ShadowDepthGl, RealObjectsAboveTheTableAreAlwaysMeasured) {
    InverseDepthField field = tableField(0.01);
    constexpr PixelRect kThing{110, 130, 116, 136};
    for (int y = kThing.y0; y < kThing.y1; ++y)
        for (int x = kThing.x0; x < kThing.x1; ++x)
            field.inverseDepth[static_cast<std::size_t>(y) * kSeen.width + x] *= 1.1F;
    for (const PixelRect& r : placed(field))
        EXPECT_EQ(around(r, kThing), r);
}

TEST_F(ShadowDepthGl, AShadowIsShownEvenIfItsObjectIsOutsideThePicture) {
    constexpr double kAside = 0.312;  // the left border of the picture cuts the shadow
    constexpr std::uint8_t kDark = 60;
    std::uint8_t found = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (int i = 0; found < kDark && std::chrono::steady_clock::now() < end; ++i) {
        view().place(above(kAside), Timestamp::fromSeconds(0.033 * i), tableField(0.01));
        ASSERT_FALSE(view().region().empty());
        EXPECT_LT(view().region().x1, kSeen.width / 4);
        found = darkest(above(kAside));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_GE(found, kDark);
    view().place(above(2 * kAside), Timestamp::fromSeconds(100), tableField(0.01));
    EXPECT_TRUE(view().region().empty());
}

TEST_F(ShadowDepthGl, AHiddenObjectIsOnlySkippedIfItsShadowIsHiddenToo) {
    InverseDepthField field = tableField(0.001);
    const auto coverColumns = [&](int from, int to) {
        for (int y = 0; y < kSeen.height; ++y)
            for (int x = from; x < to; ++x)
                field.inverseDepth[static_cast<std::size_t>(y) * kSeen.width + x] = 1 / 0.3F;
    };
    // The object's bounding box ends at column 181, the part of the table that it may shade at 205.
    coverColumns(0, 192);
    view().place(above(0), {}, field);
    EXPECT_FALSE(view().isHidden());
    coverColumns(192, kSeen.width);
    view().place(above(0), {}, field);
    EXPECT_TRUE(view().isHidden());
}

}  // namespace
}  // namespace mfar
