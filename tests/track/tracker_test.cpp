#include "pipeline/track/search_regions.h"
#include "pipeline/track/tracker.h"
#include "tests/track/tag_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mfar {
namespace {

using namespace test;

const StereoRig kRig{
    testCamera(),
    testCamera().scaledTo({1152, 864}),
    {Eigen::Quaterniond(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitY())), {-0.014, 0.001, 0}}};

std::vector<PlacedTag> world() {
    const Eigen::Quaterniond lean(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()));
    return {{{TagFamily::Tag36h11, 4}, 0.07, {Eigen::Quaterniond::Identity(), {-0.1, -0.06, 0}}},
            {{TagFamily::Tag36h11, 7}, 0.05, {lean, {0.1, 0.05, 0.02}}}};
}

TagMap mapOf(const std::vector<PlacedTag>& tags) {
    std::vector<MappedTag> out;
    for (const PlacedTag& tag : tags)
        out.push_back({tag.tag, tag.size, tag.T_world_tag});
    return TagMap(out);
}

RigidTransform view(int i) {
    return cameraAt(0.6, 0.3 + 0.004 * i, 0.2 - 0.006 * i, 0.01 * i);
}

Timestamp frameTime(int i) {
    return Timestamp::fromSeconds(2 + i / 30.);
}

GrayPicture picture(int i, const std::vector<PlacedTag>& tags = world()) {
    return renderTags(kRig.video, view(i), tags, {.noise = 1.5, .seed = static_cast<unsigned>(i)});
}

Tracker trackerFor(const TagMap& map, int fullSearchInterval = 5) {
    TrackerOptions options;
    options.map = map;
    options.fullSearchInterval = fullSearchInterval;
    return {kRig, options};
}

TEST(Tracker, FollowsTheCameraAndSearchesMostFramesInRegionsOnly) {
    Tracker tracker = trackerFor(mapOf(world()));
    for (int i = 0; i < 11; ++i) {
        const auto pose = tracker.track(picture(i).view(), frameTime(i));
        ASSERT_TRUE(pose) << i;
        ASSERT_TRUE(tracker.raw());
        EXPECT_EQ(pose->tags, 2);
        EXPECT_EQ(pose->time, frameTime(i));
        EXPECT_LT(angleBetween(pose->T_world_video, view(i)), 0.3 * kDegree) << i;
        EXPECT_LT((pose->T_world_video.translation - view(i).translation).norm(), 0.003) << i;
        EXPECT_LT(pose->reprojectionError, 0.15);
        EXPECT_GT(pose->covariance.trace(), 0);
    }
    const TrackStats stats = tracker.stats();
    EXPECT_EQ(stats.frames, 11);
    EXPECT_EQ(stats.fullSearches, 3);  // the first two frames, then every fifth
    EXPECT_EQ(stats.roiSearches, 8);
    EXPECT_EQ(stats.flips, 0);
    EXPECT_GT(stats.worstMs, 0);
    const auto ahead = tracker.predict(frameTime(12));
    ASSERT_TRUE(ahead);
    EXPECT_LT(angleBetween(ahead->T_world_video, view(12)), 0.5 * kDegree);
}

TEST(Tracker, RegionsGiveTheResultOfTheFullSearch) {
    Tracker regions = trackerFor(mapOf(world()), 1000), full = trackerFor(mapOf(world()), 1);
    for (int i = 0; i < 5; ++i) {
        const GrayPicture frame = picture(i);
        ASSERT_TRUE(regions.track(frame.view(), frameTime(i)));
        ASSERT_TRUE(full.track(frame.view(), frameTime(i)));
        ASSERT_EQ(regions.detections().size(), full.detections().size());
        for (const TagDetection& a : regions.detections())
            for (const TagDetection& b : full.detections()) {
                if (a.tag != b.tag) continue;
                for (int k = 0; k < 4; ++k)
                    EXPECT_LT((a.corners[k] - b.corners[k]).norm(), 0.02);
            }
    }
    EXPECT_EQ(regions.stats().fullSearches, 2);
    EXPECT_EQ(full.stats().roiSearches, 0);
}

TEST(Tracker, WithoutVisibleTagsPosesArePredictedAndTheWholePictureIsSearched) {
    Tracker tracker = trackerFor(mapOf(world()), 1000);
    for (int i = 0; i < 4; ++i)
        ASSERT_TRUE(tracker.track(picture(i).view(), frameTime(i)));
    const GrayPicture nothing(kRig.video.size, 90);
    for (int i = 4; i < 8; ++i) {
        const auto pose = tracker.track(nothing.view(), frameTime(i));
        ASSERT_TRUE(pose);
        EXPECT_EQ(pose->tags, 0);
        EXPECT_FALSE(tracker.raw());
    }
    EXPECT_EQ(tracker.stats().fullSearches, 2 + 4);
    EXPECT_FALSE(tracker.track(nothing.view(), frameTime(40)));
    EXPECT_TRUE(tracker.track(picture(41).view(), frameTime(41)));
}

TEST(Tracker, WithoutATagMapTheLargestTagIsTheOriginOfTheWorld) {
    TrackerOptions options;
    options.tagSize = 0.07;
    Tracker tracker(kRig, options);
    std::vector<PlacedTag> tags = world();
    EXPECT_FALSE(tracker.track(picture(0, {}).view(), frameTime(0)));
    EXPECT_TRUE(tracker.map().empty());
    for (int i = 1; i < 6; ++i) {
        EXPECT_TRUE(tracker.map().empty()) << i;
        const auto pose = tracker.track(picture(i).view(), frameTime(i));
        ASSERT_TRUE(pose);
        EXPECT_EQ(pose->tags, 1);
        const RigidTransform truth = (tags[0].T_world_tag * standOnTag()).inverse() * view(i);
        EXPECT_LT(angleBetween(pose->T_world_video, truth), 1.5 * kDegree);
        EXPECT_LT((pose->T_world_video.translation - truth.translation).norm(), 0.02);
        EXPECT_GT(pose->T_world_video.translation.z(), 0) << "the z axis must point out of the tag";
    }
    const TagMap map = tracker.map();
    ASSERT_EQ(map.tags().size(), 1U);
    EXPECT_EQ(map.find(tags[0].tag)->size, 0.07);
}

TEST(Tracker, WithoutATagMapAFalseDetectionDoesNotRemainTheOriginOfTheWorld) {
    TrackerOptions options;
    options.tagSize = 0.07;
    options.pose.filter.bridgeFrames = 2;
    Tracker tracker(kRig, options);
    std::vector<PlacedTag> wrong{world()[0]}, right{world()[0]};
    wrong[0].tag.id = 20;
    const auto first = tracker.track(picture(0, wrong).view(), frameTime(0));
    ASSERT_TRUE(first);
    for (int i = 1; i < 4; ++i)
        (void)tracker.track(picture(i, right).view(), frameTime(i));
    for (int i = 4; i < 9; ++i) {
        EXPECT_TRUE(tracker.map().empty()) << i;
        const auto pose = tracker.track(picture(i, right).view(), frameTime(i));
        ASSERT_TRUE(pose) << i;
        EXPECT_EQ(pose->tags, 1) << i;
        EXPECT_NE(pose->world, first->world) << i;
    }
    ASSERT_EQ(tracker.map().tags().size(), 1U);
    EXPECT_NE(tracker.map().find(right[0].tag), nullptr);

    // A world that has been seen for five frames stays, even if its tag is lost for long.
    for (int i = 9; i < 13; ++i)
        (void)tracker.track(picture(i, wrong).view(), frameTime(i));
    EXPECT_FALSE(tracker.track(picture(13, wrong).view(), frameTime(13)));
    EXPECT_TRUE(tracker.track(picture(14, right).view(), frameTime(14)));
    EXPECT_NE(tracker.map().find(right[0].tag), nullptr);
}

TEST(Tracker, WithoutATagMapALargeTagWithoutAPoseDoesNotHideASmallerOne) {
    TrackerOptions options;
    options.tagSize = 0.05;
    Tracker tracker(kRig, options);
    // The large tag is stretched, as on a wrongly scaled print. No pose explains its corners.
    CameraModel wide = kRig.video;
    wide.fx *= 1.7;
    const RigidTransform from = cameraAt(0.35, 0.3, 0.1, 0);
    const std::vector<PlacedTag> large{
        {{TagFamily::Tag36h11, 1}, 0.1, {Eigen::Quaterniond::Identity(), {-0.06, 0, 0}}}};
    const std::vector<PlacedTag> small{
        {{TagFamily::Tag36h11, 2}, 0.05, {Eigen::Quaterniond::Identity(), {0.15, 0, 0}}}};
    const GrayPicture stretched = renderTags(wide, from, large, {.noise = 1});
    GrayPicture both = renderTags(kRig.video, from, small, {.noise = 1});
    for (int y = 0; y < both.size.height; ++y)
        std::copy_n(&stretched.pixels[640UL * y], 450, &both.pixels[640UL * y]);
    for (int i = 0; i < 6; ++i) {
        const auto pose = tracker.track(both.view(), frameTime(i));
        if (i == 0) {
            ASSERT_EQ(tracker.detections().size(), 2U);
        }
        ASSERT_TRUE(pose) << i;
        EXPECT_LT(pose->reprojectionError, 0.1);
    }
    EXPECT_NE(tracker.map().find(small[0].tag), nullptr);
}

TEST(Tracker, PoseOfAStillComesFromTheStillItself) {
    Tracker tracker = trackerFor(mapOf(world()));
    const auto still = [&](int i) {
        return renderTags(kRig.still, view(i) * kRig.T_still_video.inverse(), world(),
                          {.noise = 1});
    };
    const auto check = [&](int i) {
        const auto pose = tracker.trackStill(still(i).view(), frameTime(i));
        ASSERT_TRUE(pose);
        EXPECT_EQ(pose->tags, 2);
        EXPECT_LT(angleBetween(pose->T_world_video, view(i)), 0.2 * kDegree);
        EXPECT_LT((pose->T_world_video.translation - view(i).translation).norm(), 0.002);
    };
    check(3);  // a still without a prediction is searched completely
    for (int i = 0; i < 3; ++i)
        ASSERT_TRUE(tracker.track(picture(i).view(), frameTime(i)));
    check(3);
    EXPECT_FALSE(tracker.trackStill(GrayPicture(kRig.still.size, 200).view(), frameTime(4)));
}

TEST(Tracker, ColourPicturesAreReadAsLuma) {
    Tracker gray = trackerFor(mapOf(world())), colour = trackerFor(mapOf(world()));
    for (int i = 0; i < 3; ++i) {
        const GrayPicture frame = picture(i);
        std::vector<std::uint8_t> rgba(frame.pixels.size() * 4, 255);
        for (std::size_t k = 0; k < frame.pixels.size(); ++k)
            for (int c = 0; c < 3; ++c)
                rgba[4 * k + c] = frame.pixels[k];
        const ImageView view{rgba.data(), frame.size, 4U * frame.size.width, PixelFormat::Rgba8};
        const auto a = gray.track(frame.view(), frameTime(i));
        const auto b = colour.track(view, frameTime(i));
        ASSERT_TRUE(a && b);
        EXPECT_EQ(a->T_world_video.translation, b->T_world_video.translation) << i;
    }
}

TEST(Tracker, HalfATagAndAGrazingTagGiveNoPose) {
    const std::vector<PlacedTag> one{world()[0]};
    const RigidTransform aside{Eigen::Quaterniond::Identity(), {0.18, -0.06, -0.5}};
    const RigidTransform flat = cameraAt(0.5, 83 * kDegree, 0) *
                                RigidTransform{Eigen::Quaterniond::Identity(), {-0.1, 0, 0}};
    for (const RigidTransform& T : {aside, flat}) {
        Tracker tracker = trackerFor(mapOf(one));
        EXPECT_FALSE(tracker.track(renderTags(kRig.video, T, one).view(), frameTime(0)));
    }
}

TEST(Tracker, BlackWhiteAndCheckeredPicturesGiveNoPose) {
    Tracker tracker = trackerFor(mapOf(world()));
    for (const int value : {0, 255})
        EXPECT_FALSE(
            tracker.track(GrayPicture(kRig.video.size, static_cast<std::uint8_t>(value)).view(),
                          frameTime(value)));
    GrayPicture texture(kRig.video.size, 0);
    for (std::size_t i = 0; i < texture.pixels.size(); ++i)
        texture.pixels[i] = (i + i / 640) % 2 == 0 ? 255 : 0;
    EXPECT_FALSE(tracker.track(texture.view(), frameTime(300)));
}

TEST(Tracker, WrongSizesAndOptionsAreRefused) {
    Tracker tracker = trackerFor(mapOf(world()));
    EXPECT_THROW((void)tracker.track(GrayPicture({320, 240}, 0).view(), {}), std::invalid_argument);
    EXPECT_THROW((void)tracker.trackStill(GrayPicture({320, 240}, 0).view(), {}),
                 std::invalid_argument);
    TrackerOptions options;
    options.tagSize = std::nan("");
    EXPECT_THROW(Tracker(kRig, options), std::invalid_argument);
    options = {};
    options.fullSearchInterval = 0;
    EXPECT_THROW(Tracker(kRig, options), std::invalid_argument);
    options = {};
    options.gamma = 0;
    EXPECT_THROW(Tracker(kRig, options), std::invalid_argument);
}

TEST(SearchRegions, RegionsToSearchContainOnlyTheVisibleTags) {
    std::vector<PlacedTag> tags = world();
    const Eigen::Quaterniond back(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY()));
    tags.push_back({{TagFamily::Tag36h11, 20}, 0.07, {back, {0, 0, 0}}});
    tags.push_back({{TagFamily::Tag36h11, 21}, 0.07, {{1, 0, 0, 0}, {3, 0, 0}}});
    tags.push_back({{TagFamily::Tag36h11, 22}, 0.07, {{1, 0, 0, 0}, {0, 0, -3}}});
    tags.push_back({{TagFamily::Tag36h11, 23}, 0.005, {{1, 0, 0, 0}, {0, 0, 1}}});
    const Matrix6 sure = Matrix6::Identity() * 1e-8;
    const auto regions = searchRegions(mapOf(tags), kRig.video, view(0), sure);
    ASSERT_EQ(regions.size(), 2U);
    for (int t = 0; t < 2; ++t)
        for (const Eigen::Vector2d& c : cornersOf(kRig.video, view(0), tags[t])) {
            const PixelRect& r = regions[t];
            EXPECT_TRUE(c.x() > r.x0 + 8 && c.y() > r.y0 + 8 && c.x() < r.x1 - 8 &&
                        c.y() < r.y1 - 8);
        }
    EXPECT_LT(areaOf(regions), 0.2 * 640 * 480);
    const auto unsure = searchRegions(mapOf(tags), kRig.video, view(0), Matrix6::Identity());
    EXPECT_EQ(unsure, (std::vector<PixelRect>{{0, 0, 640, 480}}));
}

}  // namespace
}  // namespace mfar
