#include "hal/virtual/synthetic_board.h"
#include "tests/board/board_support.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace mfar::test {
namespace {

using namespace std::chrono_literals;

/// A board with pictures of the usual sizes: such a still is rendered in several steps, which
/// alternate with video frames.
SyntheticOptions realtimeBoard() {
    SyntheticOptions options;
    options.scene = synthetic::Scene::Flat;
    options.pace = Pace::Realtime;
    return options;
}

std::vector<std::uint8_t> bytes(const Frame& frame) {
    const ImageView& v = frame.view();
    return {v.data, v.data + v.stride * v.size.height};
}

struct Delivery {
    std::vector<Timestamp> videoTimes, stillTimes;
    std::vector<std::vector<std::uint8_t>> pictures;
    std::vector<std::size_t> stillsAfterFrame;  ///< number of video frames before each still
};

/// Fetches all pictures of a board in one thread. Fires a trigger pulse after each of the frames
/// `pulses` (counted from 1). Fetches stills between frames, and the remaining stills after the
/// last frame.
Delivery runBoard(SyntheticBoard& board, const std::vector<std::size_t>& pulses) {
    Delivery out;
    board.video().start();
    board.stills().start();
    while (!board.video().ended() || !board.stills().ended()) {
        if (const auto frame = board.video().next(1s)) {
            out.videoTimes.push_back(frame->time());
            out.pictures.push_back(bytes(*frame));
            for (const std::size_t p : pulses)
                if (p == out.videoTimes.size()) board.trigger().fire();
        }
        const std::chrono::milliseconds wait = board.video().ended() ? 60s : 0s;
        while (const auto still = board.stills().next(wait)) {
            out.stillTimes.push_back(still->time());
            out.pictures.push_back(bytes(*still));
            out.stillsAfterFrame.push_back(out.videoTimes.size());
        }
    }
    return out;
}

TEST(SyntheticBoard, EqualSeedsGiveEqualPicturesAndOtherSeedsDifferentOnes) {
    SyntheticBoard a(smallBoard(5, 1)), b(smallBoard(5, 1)), c(smallBoard(5, 2));
    const Delivery first = runBoard(a, {1}), second = runBoard(b, {1}), other = runBoard(c, {1});
    ASSERT_EQ(first.pictures.size(), 6U);
    EXPECT_EQ(first.pictures, second.pictures);
    EXPECT_EQ(first.stillTimes, second.stillTimes);
    EXPECT_EQ(first.stillsAfterFrame, second.stillsAfterFrame);
    EXPECT_NE(first.pictures, other.pictures);
}

TEST(SyntheticBoard, AStillArrivesOneLatencyAfterItsTriggerPulse) {
    SyntheticBoard board(smallBoard(8));
    const Delivery run = runBoard(board, {2});
    ASSERT_EQ(run.videoTimes.size(), 8U);
    ASSERT_EQ(run.stillTimes.size(), 1U);
    // The exposure begins 1 ms after the pulse and lasts 8 ms. The time of a still is the middle of
    // its exposure. The still arrives 60 ms after the pulse, which is two frames later.
    EXPECT_EQ(run.stillTimes[0], run.videoTimes[1] + 5ms);
    EXPECT_EQ(run.stillsAfterFrame[0], 4U);
    for (std::size_t i = 1; i < run.videoTimes.size(); ++i)
        EXPECT_NEAR((run.videoTimes[i] - run.videoTimes[i - 1]).count(), 1e9 / 30, 1);
}

TEST(SyntheticBoard, WithoutAPulseNoStillArrives) {
    SyntheticBoard board(smallBoard(4));
    EXPECT_TRUE(runBoard(board, {}).stillTimes.empty());
}

TEST(SyntheticBoard, APulseDuringTheExposureIsLost) {
    SyntheticBoard board(smallBoard(6));
    EXPECT_EQ(runBoard(board, {1, 1, 2}).stillTimes.size(), 2U);
}

TEST(SyntheticBoard, APulseBeforeTheStillSensorStartsIsLost) {
    SyntheticBoard board(smallBoard(6));
    board.trigger().fire();
    EXPECT_TRUE(runBoard(board, {}).stillTimes.empty());
}

TEST(SyntheticBoard, AStillTriggeredAtTheLastFrameArrivesAfterTheEndOfTheVideo) {
    SyntheticBoard board(smallBoard(3));
    EXPECT_EQ(runBoard(board, {3}).stillTimes.size(), 1U);
}

TEST(SyntheticBoard, FramesOutliveTheBoard) {
    std::optional<Frame> frame;
    {
        SyntheticBoard board(smallBoard(3));
        board.video().start();
        frame = board.video().next(1s);
    }
    ASSERT_TRUE(frame);
    EXPECT_FALSE(bytes(*frame).empty());
}

TEST(SyntheticBoard, WaitingForAFrameTimesOutIfAllVideoBuffersAreInUse) {
    SyntheticOptions options = smallBoard();
    options.videoBuffers = 2;
    SyntheticBoard board(options);
    board.video().start();
    auto first = board.video().next(1s), second = board.video().next(1s);
    ASSERT_TRUE(first && second);
    EXPECT_FALSE(board.video().next(30ms));
    first.reset();
    EXPECT_TRUE(board.video().next(10s));
}

TEST(SyntheticBoard, AtRealtimePaceFrameTimesIncreaseAndLieBetweenStartAndNow) {
    SyntheticBoard board(realtimeBoard());
    const Timestamp before = Timestamp::now();
    board.video().start();
    Timestamp last = before - 1ns;
    for (int i = 0; i < 4; ++i) {
        const auto frame = board.video().next(20s);
        ASSERT_TRUE(frame);
        EXPECT_GT(frame->time(), last);
        EXPECT_LE(frame->time(), Timestamp::now());
        last = frame->time();
    }
}

TEST(SyntheticBoard, RealtimeStillArrivesWhileVideoRuns) {
    SyntheticBoard board(realtimeBoard());
    board.video().start();
    board.stills().start();
    ASSERT_TRUE(board.video().next(20s));
    EXPECT_FALSE(board.trigger().isStillComing());
    const Timestamp pulse = board.trigger().fire();
    EXPECT_TRUE(board.trigger().isStillComing());
    const auto still = board.stills().next(60s);
    ASSERT_TRUE(still);
    EXPECT_FALSE(board.trigger().isStillComing());
    EXPECT_EQ(still->time(), pulse + 5ms);
    EXPECT_EQ(still->exposure, 8ms);
    EXPECT_GE(Timestamp::now(), pulse + 60ms);
    EXPECT_TRUE(board.video().next(20s));
}

TEST(SyntheticBoard, StopWakesWaitingThreads) {
    SyntheticBoard board(realtimeBoard());
    board.stills().start();
    std::optional<Frame> got;
    std::thread waiter([&] { got = board.stills().next(std::chrono::hours(1)); });
    std::this_thread::sleep_for(20ms);
    board.stills().stop();
    waiter.join();
    EXPECT_FALSE(got);
    EXPECT_FALSE(board.video().next(0ms));
}

TEST(SyntheticBoard, DifferentThreadsMayUseCamerasTriggerAndGroundTruth) {
    SyntheticBoard board(smallBoard(12));
    board.video().start();
    board.stills().start();
    int stills = 0;
    std::thread consumer([&] {
        while (!board.stills().ended())
            if (board.stills().next(50ms)) ++stills;
    });
    int frames = 0;
    Size truth;
    while (!board.video().ended()) {
        const auto frame = board.video().next(1s);
        if (!frame) continue;
        if (++frames == 3) board.trigger().fire();
        if (frames == 5) truth = board.cleanVideo(frame->time()).size;
    }
    consumer.join();
    EXPECT_EQ(frames, 12);
    EXPECT_EQ(truth, (Size{160, 120}));
    EXPECT_EQ(stills, 1);
}

}  // namespace
}  // namespace mfar::test
