#include "pipeline/track/corner_refine.h"
#include "pipeline/track/tag_detector.h"
#include "tests/track/tag_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mfar {
namespace {

using namespace test;

RigidTransform upright(double x = 0, double y = 0) {
    return {Eigen::Quaterniond::Identity(), {x, y, 0}};
}

double rootMeanSquare(const std::array<Eigen::Vector2d, 4>& a,
                      const std::array<Eigen::Vector2d, 4>& b) {
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        sum += (a[k] - b[k]).squaredNorm();
    return std::sqrt(sum / 4);
}

TagDetector detectorFor(std::vector<TagFamily> families, double decimation) {
    DetectorOptions options;
    options.families = std::move(families);
    options.decimation = decimation;
    return TagDetector(options);
}

TEST(TagFamilies, TagFamiliesAgreeWithLibapriltag) {
    for (const TagFamilyInfo& family : kTagFamilies) {
        const TagPicture last = drawTag({family.family, family.count - 1});
        EXPECT_EQ(last.size - 2 * last.corner, family.cells) << family.name;
        const auto at = [&](int x, int y) { return last.cells[y * last.size + x]; };
        const int inside = last.corner, outside = last.corner - 1;
        EXPECT_EQ(at(inside, inside) > 127, family.brightInside) << family.name;
        EXPECT_EQ(at(outside, outside) > 127, !family.brightInside) << family.name;
        EXPECT_THROW((void)drawTag({family.family, family.count}), std::invalid_argument);
        EXPECT_EQ(tagFamilyNamed(family.name), family.family);
    }
}

TEST(TagDetector, FindsEveryFamilyWithItsCornersInOrder) {
    const CameraModel camera = testCamera();
    std::vector<PlacedTag> tags;
    for (int i = 0; i < 4; ++i)
        tags.push_back({{kTagFamilies[i].family, 5 + i}, 0.08, upright(0.19 * i - 0.28)});
    const RigidTransform T = cameraAt(0.7, 0.2, -0.1, 0.4);
    const GrayPicture picture = renderTags(camera, T, tags, {.noise = 2});
    TagDetector detector = detectorFor(
        {TagFamily::Tag16h5, TagFamily::TagStandard41h12, TagFamily::Tag36h11, TagFamily::Tag25h9},
        2);
    const auto found = detector.detect(picture.view());
    ASSERT_EQ(found.size(), 4U);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(found[i].tag, tags[i].tag);
        EXPECT_EQ(found[i].hamming, 0);
        EXPECT_LT(rootMeanSquare(found[i].corners, cornersOf(camera, T, tags[i])), 0.6);
    }
}

// The picture has linear sensor values, so that gamma does not move edges. Only a wrong convention
// of pixel centres can then shift the corners on average.
TEST(TagDetector, PixelCentresAreAtIntegers) {
    const CameraModel camera = testCamera();
    for (const double decimation : {1., 1.5, 2., 3.}) {
        TagDetector detector = detectorFor({TagFamily::Tag36h11}, decimation);
        Eigen::Vector2d bias = Eigen::Vector2d::Zero();
        for (int i = 0; i < 6; ++i) {
            const PlacedTag tag{{TagFamily::Tag36h11, i}, 0.05, upright(0.02 * std::sin(i))};
            const RigidTransform T = cameraAt(0.6, 0.1, 0.2, i);
            const GrayPicture picture = renderTags(camera, T, {tag}, {.gamma = 1, .noise = 1});
            const auto found = detector.detect(picture.view());
            ASSERT_EQ(found.size(), 1U) << decimation;
            const auto truth = cornersOf(camera, T, tag);
            for (int k = 0; k < 4; ++k)
                bias += (found[0].corners[k] - truth[k]) / 24;
        }
        EXPECT_LT(bias.norm(), 0.06) << decimation << ": " << bias.transpose();
    }
}

TEST(CornerRefiner, MeasuresCornersToAFewHundredthsOfAPixel) {
    const CameraModel camera = testCamera();
    for (const auto& [family, gamma] : {std::pair{TagFamily::Tag36h11, 2.2},
                                        {TagFamily::TagStandard41h12, 2.2},
                                        {TagFamily::Tag36h11, 1.}}) {
        TagDetector detector = detectorFor({family}, 2);
        for (int i = 0; i < 4; ++i) {
            const PlacedTag tag{{family, i}, 0.07, upright(0.15 * std::sin(i), 0.1)};
            const RigidTransform T = cameraAt(0.6, 0.3 * std::cos(i), 0.5, i);
            const GrayPicture picture = renderTags(
                camera, T, {tag}, {.gamma = gamma, .noise = 2, .seed = static_cast<unsigned>(i)});
            auto found = detector.detect(picture.view());
            ASSERT_EQ(found.size(), 1U);
            const auto truth = cornersOf(camera, T, tag);
            const double before = rootMeanSquare(found[0].corners, truth);
            CornerRefiner(gamma).refine(picture.view(), camera, found[0]);
            EXPECT_LT(rootMeanSquare(found[0].corners, truth), 0.08);
            EXPECT_LT(rootMeanSquare(found[0].corners, truth), before);
        }
    }
}

TEST(CornerRefiner, CornersInUniformPicturesStayUnchanged) {
    const CameraModel camera = testCamera();
    TagDetection made;
    made.corners = {{{100, 140}, {140, 140}, {140, 100}, {100, 100}}};
    for (const int value : {0, 128, 255}) {
        TagDetection detection = made;
        const GrayPicture picture(camera.size, static_cast<std::uint8_t>(value));
        CornerRefiner().refine(picture.view(), camera, detection);
        EXPECT_EQ(detection.corners, made.corners);
    }
    for (Eigen::Vector2d& corner : made.corners)
        corner.array() -= 139.5;  // moves three corners out of the picture
    TagDetection detection = made;
    CornerRefiner().refine(GrayPicture(camera.size, 90).view(), camera, detection);
    EXPECT_EQ(detection.corners, made.corners);
}

TEST(TagDetector, ARegionGivesTheResultOfTheWholePicture) {
    const CameraModel camera = testCamera();
    const std::vector<PlacedTag> tags{{{TagFamily::Tag36h11, 1}, 0.06, upright(-0.15, -0.1)},
                                      {{TagFamily::Tag36h11, 2}, 0.06, upright(0.15, 0.1)}};
    const RigidTransform T = cameraAt(0.6, 0.2, 0.1, 0.3);
    const GrayPicture picture = renderTags(camera, T, tags, {.noise = 2});
    for (const double decimation : {1., 1.5, 2., 3.}) {
        TagDetector detector = detectorFor({TagFamily::Tag36h11}, decimation);
        const auto all = detector.detect(picture.view());
        ASSERT_EQ(all.size(), 2U) << decimation;
        for (const TagDetection& one : all) {
            PixelRect box{640, 480, 0, 0};
            for (const Eigen::Vector2d& c : one.corners) {
                box = {std::min(box.x0, static_cast<int>(c.x()) - 20),
                       std::min(box.y0, static_cast<int>(c.y()) - 20),
                       std::max(box.x1, static_cast<int>(c.x()) + 20),
                       std::max(box.y1, static_cast<int>(c.y()) + 20)};
            }
            const auto inside = detector.detect(picture.view(), box);
            ASSERT_EQ(inside.size(), 1U) << decimation;
            EXPECT_EQ(inside[0].tag, one.tag);
            EXPECT_LT(rootMeanSquare(inside[0].corners, one.corners), 1e-4) << decimation;
        }
    }
}

TEST(TagDetector, RegionsAreClippedToThePictureAndCanBeEmpty) {
    TagDetector detector = detectorFor({TagFamily::Tag36h11}, 2);
    const GrayPicture picture({320, 240}, 77);
    for (const PixelRect region : {PixelRect{-500, -500, -100, -100},
                                   {300, 200, 900, 900},
                                   {10, 10, 5, 5},
                                   {0, 0, 0, 0},
                                   {319, 239, 320, 240}})
        EXPECT_TRUE(detector.detect(picture.view(), region).empty());
}

TEST(TagDetector, NoTagIsFoundInBlackWhiteAndTinyPictures) {
    for (const double blur : {0., 0.8})
        for (const double decimation : {1., 2.}) {
            DetectorOptions options;
            options.decimation = decimation;
            options.blur = blur;
            TagDetector detector(options);
            for (const Size size : {Size{640, 480}, {641, 479}, {1, 1}, {33, 17}, {3, 400}, {0, 0}})
                for (const int value : {0, 255}) {
                    const GrayPicture picture(size, static_cast<std::uint8_t>(value));
                    EXPECT_TRUE(detector.detect(picture.view()).empty());
                }
        }
}

TEST(TagDetector, DoesNotWriteToItsInput) {
    const CameraModel camera = testCamera();
    const PlacedTag tag{{TagFamily::Tag36h11, 3}, 0.08, upright()};
    const GrayPicture picture = renderTags(camera, cameraAt(0.6, 0, 0), {tag}, {.noise = 2});
    const std::vector<std::uint8_t> before(picture.pixels.begin(), picture.pixels.end());
    DetectorOptions options;
    options.decimation = 1;
    options.blur = 1;
    EXPECT_EQ(TagDetector(options).detect(picture.view()).size(), 1U);
    EXPECT_EQ(picture.pixels, before);
}

TEST(TagDetector, InputThatCrashesTheLibraryIsRefused) {
    const auto refused = [](auto change) {
        DetectorOptions options;
        change(options);
        EXPECT_THROW(TagDetector{options}, std::invalid_argument);
    };
    refused([](DetectorOptions& o) { o.families.clear(); });
    refused([](DetectorOptions& o) { o.decimation = 0; });
    refused([](DetectorOptions& o) { o.decimation = 1.2; });
    refused([](DetectorOptions& o) { o.decimation = std::nan(""); });
    refused([](DetectorOptions& o) { o.threads = 0; });
    refused([](DetectorOptions& o) { o.blur = -1; });
    refused([](DetectorOptions& o) { o.maxHamming = 2; });
    TagDetector detector{DetectorOptions{}};
    const std::vector<std::uint8_t> pixels(64 * 64 * 4, 0);
    EXPECT_THROW((void)detector.detect({pixels.data(), {64, 64}, 256, PixelFormat::Rgba8}),
                 std::invalid_argument);
    EXPECT_THROW((void)detector.detect({pixels.data(), {40000, 1}, 40000, PixelFormat::Gray8}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace mfar
