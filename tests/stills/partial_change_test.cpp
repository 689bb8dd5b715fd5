#include "pipeline/pipeline.h"
#include "tests/engine/gl_test.h"
#include "tests/learn/sensor_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace mfar {
namespace {

using twin::Grey;
using Bytes = std::vector<std::uint8_t>;

constexpr int kFlatFrom = 768, kChangedFrom = 832;  // columns of the still
constexpr int kShift = 24;                          // motion of the video camera [px of the still]
constexpr int kComparedCells = 40;  // columns of cells; 48 are left of the flat part

/// How the right side of the second frame differs from that of the first one.
enum class Change { None, Flat, Discs };

/// Keeps the look-ups with which the last frame was drawn.
struct LastLookUps final : MatchListener {
    void matched(const RgbPlanes&, Rows<const std::uint8_t>, Rows<const LookUpCell>,
                 const MatchedPictures::LookedUp&) override {}
    void replaced(const RgbPlanes&, Rows<const std::uint8_t>, Rows<const LookUpCell> lookUps,
                  const MatchedPictures::LookedUp&) override {
        cells.clear();
        for (int y = 0; y < lookUps.size.height; ++y)
            cells.insert(cells.end(), lookUps[y], lookUps[y] + kComparedCells);
    }
    std::vector<LookUpCell> cells;
};

/// A scene with discs and, at its right side, a surface without structure. The camera has moved
/// between still and video. With Change::Flat, the surface's level rises towards its right side, so
/// slowly that no tile gets structure. With Change::Discs, discs appear there.
Grey scene(Change change, int shift) {
    static const Grey discs = sharpDiscs(1);
    const auto disc = [&](int x, int y) {
        return discs.at(std::min(x + shift, kDiscsStill.width - 1), y);
    };
    return twin::greyOf(kDiscsStill, [&](int x, int y) {
        if (x < kFlatFrom) return double(disc(x, y));
        if (x < kChangedFrom || change == Change::None) return 100.0;
        if (change == Change::Discs) return double(disc(x, y));
        return 100 + 16.0 * (x - kChangedFrom) / (kDiscsStill.width - kChangedFrom);
    });
}

class PartialChange : public GlTest, public testing::WithParamInterface<EngineKind> {
protected:
    PartialChange() {
        pose_.T_world_video.translation.x() = kShift / discsRig().still.fx;  // the scene is at 1 m
    }

    /// Draws frames until one uses `pose`, or uses no pose if `pose` is not given.
    void draw(Pipeline& pipeline, const std::optional<Pose>& pose) const {
        const Bytes video = bytesOf(videoOf(scene(Change::None, kShift), {}));
        const ImageView view{video.data(), kDiscsVideo, std::size_t(kDiscsVideo.width),
                             PixelFormat::Gray8};
        for (int i = 0; i < 10'000; ++i) {
            if (pipeline.run(view, {}, pose).stats.usedPose == pose.has_value()) return;
            pipeline.redraw();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        FAIL() << "no frame has used its pose";
    }

    /// Returns the look-ups after a frame with the pose `first`. If `second` is given, returns
    /// those after another frame with the pose *second, which differs by `change`.
    std::vector<LookUpCell> lookUps(const std::optional<Pose>& first,
                                    const std::optional<std::optional<Pose>>& second,
                                    Change change) const {
        Pipeline pipeline(discsRig(), {.output = {}, .engines = EngineChoice::all(GetParam())});
        LastLookUps last;
        pipeline.setMatchListener(&last);
        pipeline.setFilters(std::make_shared<const FilterBank>(
            std::vector<FilterBank::Filter>(enlarge::kUnique, FilterBank::Filter{}), Guidance{},
            FineMatch{0.5F, 0.001F}));
        const Bytes still = bytesOf(scene(Change::None, 0));
        const ImageView view{still.data(), kDiscsStill, std::size_t(kDiscsStill.width),
                             PixelFormat::Gray8};
        pipeline.setStill(view, {}, Pose{});
        draw(pipeline, first);
        if (second) {
            const Bytes video = bytesOf(videoOf(scene(change, kShift), {}));
            const FrameStats stats = pipeline
                                         .run({video.data(), kDiscsVideo,
                                               std::size_t(kDiscsVideo.width), PixelFormat::Gray8},
                                              {}, *second)
                                         .stats;
            EXPECT_GT(stats.changed, 0.05);
            EXPECT_LT(stats.changed, 0.4);
            EXPECT_EQ(stats.usedPose, second->has_value());
        }
        pipeline.setStill(view, {}, Pose{});
        return last.cells;
    }

    void expectNoEffect(const std::optional<Pose>& first, const std::optional<Pose>& second) const {
        const std::vector<LookUpCell> before = lookUps(first, {}, Change::None),
                                      after = lookUps(first, {second}, Change::Flat);
        ASSERT_EQ(before.size(), after.size());
        std::size_t weighed = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            weighed += before[i].weight > 0.5F;
            ASSERT_NEAR(after[i].x, before[i].x, 0.001) << i;
            ASSERT_NEAR(after[i].y, before[i].y, 0.001) << i;
            ASSERT_NEAR(after[i].weight, before[i].weight, 0.01) << i;
            ASSERT_NEAR(after[i].confidenceAndJumps, before[i].confidenceAndJumps, 0.01) << i;
        }
        EXPECT_GT(weighed, before.size() / 4);
    }

    /// A frame with the pose `first`, and one with `second` in which tiles with structure have
    /// changed: nearly all look-ups of other tiles must stay.
    void expectLittleEffect(const std::optional<Pose>& first, const std::optional<Pose>& second,
                            double most = 0.02) const {
        const std::vector<LookUpCell> before = lookUps(first, {}, Change::None),
                                      after = lookUps(first, {second}, Change::Discs);
        ASSERT_EQ(before.size(), after.size());
        double weighed = 0, changed = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (before[i].weight < 0.5F) continue;
            ++weighed;
            changed += std::hypot(after[i].x - before[i].x, after[i].y - before[i].y) > 0.1F ||
                       std::abs(after[i].weight - before[i].weight) > 0.05F;
        }
        EXPECT_GT(weighed, before.size() / 4);
        EXPECT_LT(changed / weighed, most);
    }

    Pose pose_;
};
INSTANTIATE_TEST_SUITE_P(Engines, PartialChange,
                         testing::Values(EngineKind::Simd, EngineKind::Gles),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

TEST_P(PartialChange, HasNoEffectOnMatchedTiles) {
    expectNoEffect({}, {});
}

TEST_P(PartialChange, HasNoEffectOnTilesMatchedAlongEpipolarLines) {
    expectNoEffect(pose_, pose_);
}

TEST_P(PartialChange, InAFrameWithoutAPoseHasNoEffectOnTilesMatchedAlongEpipolarLines) {
    expectNoEffect(pose_, {});
}

TEST_P(PartialChange, OfStructuredTilesHasLittleEffectOnOtherTiles) {
    expectLittleEffect({}, {});
}

TEST_P(PartialChange, OfStructuredTilesHasLittleEffectOnOtherTilesMatchedAlongEpipolarLines) {
    expectLittleEffect(pose_, pose_);
}

TEST_P(PartialChange, OfStructuredTilesInAFrameWithoutAPoseHasLittleEffectOnOtherTiles) {
    // Without a pose, errors are measured in another way.
    expectLittleEffect(pose_, {}, 0.12);
}

}  // namespace
}  // namespace mfar
