#include "tests/board/board_support.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <chrono>

namespace mfar::test {
namespace {

using namespace std::chrono_literals;

constexpr double kGamma = 2.2;

cv::Mat3f linear(const cv::Mat3f& picture) {
    cv::Mat3f out;
    cv::pow(picture, kGamma, out);
    return out;
}

class EveryScene : public testing::TestWithParam<synthetic::Scene> {};

struct Pair {
    std::optional<Frame> video, still;
};
Pair takePair(SyntheticBoard& board) {
    board.video().start();
    board.stills().start();
    Pair out;
    out.video = board.video().next(10s);
    board.trigger().fire();
    for (int i = 0; i < 10 && !out.still; ++i) {
        const auto passed = board.video().next(10s);
        out.still = board.stills().next(0ms);
    }
    return out;
}

void expectTags(const SyntheticBoard& board, const ImageView& picture, const CameraModel& camera,
                const RigidTransform& T_world_camera, double tolerance) {
    const auto found = detectTags(grey(picture));
    for (const synthetic::Tag& tag : board.world().tags) {
        ASSERT_TRUE(found.contains(tag.id)) << "tag " << tag.id;
        const auto expected = projectedCorners(tag, camera, T_world_camera);
        for (int k = 0; k < 4; ++k)
            EXPECT_LT((found.at(tag.id)[k] - expected[k]).norm(), tolerance)
                << "tag " << tag.id << " corner " << k;
    }
}

TEST_P(EveryScene, TheTagsAreAtTheirTruePositionsInThePicturesOfBothSensors) {
    SyntheticBoard& board = sharedBoard(GetParam());
    const Pair pair = takePair(board);
    ASSERT_TRUE(pair.video && pair.still);
    const StereoRig& rig = board.rig();
    const RigidTransform T_world_video = board.pose(pair.video->time()).T_world_video;
    expectTags(board, pair.video->view(), rig.video, T_world_video, 0.5);
    const RigidTransform T_world_still =
        board.pose(pair.still->time()).T_world_video * rig.T_still_video.inverse();
    expectTags(board, pair.still->view(), rig.still, T_world_still, 0.8);
}

TEST_P(EveryScene, TheTrueHighResolutionPictureReducedToVideoSizeNearlyEqualsTheVideo) {
    SyntheticBoard& board = sharedBoard(GetParam());
    const Timestamp t = board.epoch() + 700ms;
    const cv::Mat3f video = linear(colour(board.cleanVideo(t)));
    cv::Mat3f high = linear(colour(board.highRes(t))), small;
    cv::resize(high, small, video.size(), 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {3, 3}, 0.36);
    EXPECT_GT(psnr(small, video), 36);
}

INSTANTIATE_TEST_SUITE_P(Synthetic, EveryScene,
                         testing::Values(synthetic::Scene::Office, synthetic::Scene::Shelf,
                                         synthetic::Scene::Outdoor, synthetic::Scene::Flat,
                                         synthetic::Scene::Moving, synthetic::Scene::Still),
                         [](const auto& p) { return std::string(synthetic::name(p.param)); });

TEST(SyntheticPicture, CalibrationTagsAreAtTheirTruePositions) {
    SyntheticOptions options;
    options.scene = synthetic::Scene::Calibration;
    options.path = synthetic::Path::Rest;
    options.pace = Pace::Consumer;
    SyntheticBoard board(options);
    const Timestamp t = board.epoch();
    cv::Mat1b picture = grey(board.cleanVideo(t).view());
    // Separates the black squares between the tags from the tags' corners. Where they touch, the
    // detector does not find the tag.
    cv::dilate(picture, picture, cv::Mat::ones(3, 3, CV_8U));
    const auto found = detectTags(picture);
    EXPECT_GE(found.size(), 30U);
    for (const synthetic::Tag& tag : board.world().tags) {
        if (!found.contains(tag.id)) continue;
        const auto expected = projectedCorners(tag, board.rig().video, board.pose(t).T_world_video);
        for (int k = 0; k < 4; ++k)
            EXPECT_LT((found.at(tag.id)[k] - expected[k]).norm(), 2.5)
                << "tag " << tag.id << " corner " << k;
    }
}

double lostInVideo(synthetic::Scene scene) {
    SyntheticBoard& board = sharedBoard(scene);
    const Timestamp t = board.epoch();
    const cv::Mat3f high = colour(board.highRes(t));
    cv::Mat3f up;
    cv::resize(colour(board.cleanVideo(t)), up, high.size(), 0, 0, cv::INTER_CUBIC);
    return psnr(up, high);
}

TEST(SyntheticPicture, TheHighResolutionPictureShowsDetailThatTheVideoLacks) {
    const double office = lostInVideo(synthetic::Scene::Office);
    EXPECT_LT(office, 27);
    EXPECT_LT(lostInVideo(synthetic::Scene::Outdoor), 28);
    EXPECT_GT(lostInVideo(synthetic::Scene::Flat), office + 6);
}

TEST(SyntheticPicture, PicturesHaveSmallNoise) {
    SyntheticBoard& board = sharedBoard(synthetic::Scene::Flat);
    board.video().start();
    const auto frame = board.video().next(10s);
    ASSERT_TRUE(frame);
    const cv::Mat1b noisy = grey(frame->view());
    const StoredImage clean = board.cleanVideo(frame->time());
    cv::Mat difference;
    cv::subtract(noisy, grey(clean.view()), difference, {}, CV_32F);
    cv::Scalar mean, sigma;
    cv::meanStdDev(difference, mean, sigma);
    EXPECT_NEAR(mean[0], 0, 0.2);
    EXPECT_GT(sigma[0], 0.5);
    EXPECT_LT(sigma[0], 3);
}

}  // namespace
}  // namespace mfar::test
