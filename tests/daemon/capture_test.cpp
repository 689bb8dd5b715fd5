#include "daemon/capture.h"
#include "tests/daemon/fake_cameras.h"

#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <memory>
#include <string>

namespace mfar {
namespace {

using namespace std::chrono_literals;
using test::FakeCamera;
using test::FakeSource;

PoseConfig noPoses() {
    PoseConfig config;
    config.source = PoseOrigin::None;
    return config;
}

struct Capture {
    explicit Capture(HandOver handOver, bool sensors = false)
        : source(new FakeSource(handOver, sensors)), rig(std::unique_ptr<RigSource>(source)),
          poses(noPoses(), rig.poseInputs(), stats), mailbox(handOver),
          thread(std::in_place, rig, poses, stats, mailbox) {}

    FakeCamera& video() { return source->videoCamera; }
    FakeCamera& still() { return source->stillCamera; }
    std::optional<CapturedFrame> take() { return mailbox.takeWithin(20s); }

    FakeSource* source;  ///< owned by the rig
    Rig rig;
    Stats stats;
    PoseFinder poses;
    Mailbox<CapturedFrame> mailbox;
    std::optional<CaptureThread> thread;
};

bool becomesTrue(const std::function<bool()>& condition) {
    for (const auto end = std::chrono::steady_clock::now() + 20s;
         std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(1ms))
        if (condition()) return true;
    return false;
}

/// Returns the message of the error that ends the capture.
std::string endOf(Capture& capture) {
    const auto isOver = [&] {
        (void)capture.mailbox.tryTake();  // a frame may have arrived before the fault was noticed
        return capture.mailbox.over();
    };
    if (!becomesTrue(isOver)) return "the capture does not end";
    try {
        capture.thread->stop();
        capture.thread->join();
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "";
}

TEST(CaptureThread, VideoFramesArriveWhileTheStillCameraHangs) {
    Capture capture(HandOver::NewestWins);
    capture.still().hang(true);
    ASSERT_TRUE(capture.still().isHung());
    for (int i = 1; i <= 5; ++i) {
        capture.video().send(i);
        const auto frame = capture.take();
        ASSERT_TRUE(frame) << i;
        EXPECT_EQ(frame->video.time(), Timestamp::fromSeconds(i));
        EXPECT_FALSE(frame->still);
    }
    auto ended = std::async(std::launch::async, [&] {
        capture.thread->stop();
        capture.thread->join();
    });
    EXPECT_EQ(ended.wait_for(20s), std::future_status::ready);
    capture.still().hang(false);
}

TEST(CaptureThread, ShutdownDoesNotWaitForAHangingVideoCamera) {
    Capture capture(HandOver::NewestWins);
    capture.video().hang(true);
    ASSERT_TRUE(capture.video().isHung());
    auto ended = std::async(std::launch::async, [&] {
        capture.thread->stop();
        capture.thread->join();
    });
    EXPECT_EQ(ended.wait_for(20s), std::future_status::ready);
    capture.video().hang(false);
}

TEST(CaptureThread, AStillIsDeliveredWithTheFirstFrameThatIsNotOlder) {
    Capture capture(HandOver::NewestWins);
    capture.still().send(1.5);
    ASSERT_TRUE(becomesTrue([&] { return capture.stats.count().stills.received == 1; }));
    capture.video().send(1);
    EXPECT_FALSE(capture.take()->still);
    std::optional<CapturedFrame> with;
    double time = 2;
    ASSERT_TRUE(becomesTrue([&] {
        capture.video().send(time++);
        with = capture.take();
        return with && with->still;
    }));
    EXPECT_EQ(with->still->frame.time(), Timestamp::fromSeconds(1.5));
    EXPECT_NE(capture.video().askers(), capture.still().askers());
}

TEST(CaptureThread, StillsReplacedBeforeAFrameUsedThemAreCounted) {
    Capture capture(HandOver::NewestWins);
    for (int i = 1; i <= 5; ++i)
        capture.still().send(i);
    ASSERT_TRUE(becomesTrue(
        [&] { return capture.stats.count().stills.superseded == 5 - StillBox::kCapacity; }));
    capture.video().send(10);
    const auto frame = capture.take();
    ASSERT_TRUE(frame && frame->still);
    EXPECT_EQ(frame->still->frame.time(), Timestamp::fromSeconds(5))
        << "the newest still must come with the frame";
    EXPECT_EQ(frame->stillsSuperseded, StillBox::kCapacity - 1);
}

TEST(CaptureThread, ADroppedFrameGivesItsStillAndItsCountOfReplacedStillsToTheNextFrame) {
    CapturedFrame older{{ImageView{}, Timestamp{1}, nullptr},
                        CapturedStill{{ImageView{}, Timestamp{1}, nullptr}},
                        {}};
    older.stillsSuperseded = 3;
    CapturedFrame newer{{ImageView{}, Timestamp{2}, nullptr}, std::nullopt, {}};
    newer.supersede(std::move(older));
    EXPECT_TRUE(newer.still);
    EXPECT_EQ(newer.stillsSuperseded, 3U);
    CapturedFrame newest{{ImageView{}, Timestamp{3}, nullptr},
                         CapturedStill{{ImageView{}, Timestamp{3}, nullptr}},
                         {}};
    newest.supersede(std::move(newer));
    EXPECT_EQ(newest.still->frame.time(), Timestamp{3});
    EXPECT_EQ(newest.stillsSuperseded, 4U);
}

TEST(CaptureThread, AnInvalidStillEndsTheRunInEveryHandOverMode) {
    for (const HandOver handOver : {HandOver::NewestWins, HandOver::Lossless}) {
        Capture capture(handOver);
        capture.still().send(1, 0, Size{4, 4});
        capture.video().send(2);
        EXPECT_EQ(endOf(capture),
                  "fake still: sent a picture of 4x4, but the calibration is for 16x12");
    }
}

TEST(CaptureThread, AFailingStillCameraEndsTheRunInEveryHandOverMode) {
    for (const HandOver handOver : {HandOver::NewestWins, HandOver::Lossless}) {
        Capture capture(handOver);
        capture.still().fail("the still camera has burnt");
        capture.video().send(2);
        EXPECT_EQ(endOf(capture), "the still camera has burnt");
    }
}

TEST(CaptureThread, TheMissedFramesOfTheCameraAreReported) {
    Capture capture(HandOver::NewestWins);
    CameraCounters counters;
    counters.missed = 7;
    counters.broken = 2;
    capture.video().count(counters);
    counters.missed = 1;
    capture.still().count(counters);
    capture.video().warn("few buffers");
    ASSERT_TRUE(becomesTrue([&] {
        const Counted counted = capture.stats.count();
        return counted.drops.sensor == 7 && counted.cameras[1].counters.missed == 1;
    }));
    EXPECT_EQ(capture.stats.count().cameras[0].counters.broken, 2U);
    const std::vector<Warning> warnings = capture.stats.takeWarnings();
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].text, "few buffers");
    EXPECT_EQ(warnings[0].subject.camera, "video");
}

TEST(CaptureThread, ASlowerRateThanConfiguredDoesNotCountAsDrops) {
    Capture capture(HandOver::NewestWins);
    const auto send = [&](double time) {
        capture.video().send(time);
        return capture.take().has_value();
    };
    int i = 0;
    for (; i < 40; ++i)
        ASSERT_TRUE(send(i / 15.));
    EXPECT_EQ(capture.stats.count().drops.sensor, 0U)
        << "a rate below the configured 30 Hz is not a drop";
    EXPECT_NEAR(capture.stats.count().cameras[0].rateHz, 15, 0.01);
    EXPECT_EQ(capture.stats.count().cameras[0].configuredHz, 30);
    ASSERT_TRUE(send((i + 3) / 15.));
    EXPECT_EQ(capture.stats.count().drops.sensor, 3U);
}

TEST(CaptureThread, RepeatedPicturesAreDetectedOnlyForRealSensors) {
    for (const bool sensors : {true, false}) {
        Capture capture(HandOver::NewestWins, sensors);
        for (int i = 1; i <= 5; ++i) {
            capture.video().send(i, 9);
            ASSERT_TRUE(capture.take());
        }
        const CameraState video = capture.stats.count().cameras[0];
        EXPECT_EQ(video.repeated, sensors ? 4U : 0U);
        EXPECT_EQ(video.distinctAgeS.has_value(), sensors);
    }
}

TEST(CaptureThread, OneThreadReadsALosslessSourceInOrder) {
    Capture capture(HandOver::Lossless);
    // The thread that fetches the frames also fetches the stills. Each frame must come with the
    // still before it.
    for (int i = 1; i <= 4; ++i)
        capture.still().send(i);
    for (int i = 1; i <= 4; ++i)
        capture.video().send(i + 0.5);
    capture.video().end();
    for (int i = 1; i <= 4; ++i) {
        const auto frame = capture.take();
        ASSERT_TRUE(frame && frame->still) << i;
        EXPECT_EQ(frame->still->frame.time(), Timestamp::fromSeconds(i));
        EXPECT_EQ(frame->stillsSuperseded, 0U);
    }
    EXPECT_FALSE(capture.take());
    EXPECT_EQ(endOf(capture), "");
    EXPECT_EQ(capture.video().askers(), capture.still().askers());
    EXPECT_EQ(capture.video().askers().size(), 1U);
}

}  // namespace
}  // namespace mfar
