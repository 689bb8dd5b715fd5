#include "hal/virtual/recording_player.h"
#include "tests/unit/small_recording.h"

#include <gtest/gtest.h>

#include <thread>

namespace mfar {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::TempFolder;
using test::writeSmallRecording;

constexpr std::int64_t kMs = 1'000'000;

/// Fetches pictures from both cameras in turn in one thread. Returns them as text: "V" (video) or
/// "S" (still), the time [ms], "=", the grey level.
std::string played(RecordingPlayer& player, std::size_t limit = 1000) {
    std::string seen;
    for (std::size_t n = 0; n < limit && !(player.video().ended() && player.stills().ended());) {
        const auto note = [&](const char* kind, const Frame& f) {
            seen += fmt::format("{}{}={} ", kind, f.time().ns / kMs, f.view().data[0]);
            ++n;
        };
        if (const auto still = player.stills().next(milliseconds(0)))
            note("S", *still);
        else if (const auto frame = player.video().next(seconds(10)))
            note("V", *frame);
    }
    return seen;
}

void startBoth(RecordingPlayer& player) {
    player.video().start();
    player.stills().start();
}

TEST(RecordingPlayer, AtConsumerPaceAllPicturesComeInTheOrderOfTimeInEveryRun) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 33 * kMs, 66 * kMs, 100 * kMs},
                        {33 * kMs, 50 * kMs, 51 * kMs, 52 * kMs, 200 * kMs});
    for (int run = 0; run < 20; ++run) {
        RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Consumer});
        startBoth(player);
        EXPECT_EQ(played(player), "V0=0 S33=0 V33=10 S50=10 S51=20 S52=30 V66=20 V100=30 S200=40 ");
    }
}

TEST(RecordingPlayer, AtConsumerPaceAStillWaitsForTheVideoFramesBeforeIt) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 33 * kMs}, {20 * kMs});
    RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Consumer});
    startBoth(player);
    EXPECT_FALSE(player.stills().next(milliseconds(30)).has_value());
    EXPECT_EQ(player.video().next(seconds(10))->time().ns, 0);
    EXPECT_EQ(player.stills().next(milliseconds(0))->time().ns, 20 * kMs);
    EXPECT_TRUE(player.stills().ended());
    EXPECT_FALSE(player.video().ended());
}

TEST(RecordingPlayer, AtConsumerPaceAllStillsUpToTheLastDeliveredVideoFrameAreAvailable) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 33 * kMs, 66 * kMs},
                        {5 * kMs, 33 * kMs, 40 * kMs, 90 * kMs});
    for (int run = 0; run < 20; ++run) {
        RecordingPlayer player(loadRecording(folder.path()),
                               {.pace = Pace::Consumer, .asksVideoFirst = true});
        startBoth(player);
        const auto next = [](Camera& camera) {
            const std::optional<Frame> frame = camera.next(milliseconds(0));
            return frame ? frame->time().ns : -1;
        };
        EXPECT_EQ(next(player.video()), 0);
        EXPECT_EQ(next(player.stills()), -1)
            << "the next still is later than the video and must wait";
        EXPECT_EQ(next(player.video()), 33 * kMs);
        EXPECT_EQ(next(player.stills()), 5 * kMs);
        EXPECT_EQ(next(player.stills()), 33 * kMs);
        EXPECT_EQ(next(player.stills()), -1);
        EXPECT_EQ(next(player.video()), 66 * kMs);
        EXPECT_EQ(next(player.stills()), 40 * kMs);
        EXPECT_EQ(next(player.stills()), 90 * kMs) << "no video frame is left to wait for";
        EXPECT_TRUE(player.stills().ended());
    }
}

TEST(RecordingPlayer, AtConsumerPaceThePlayerWaitsOnlyForBuffersThatTheConsumerHolds) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 33 * kMs, 66 * kMs}, {});
    RecordingPlayer player(loadRecording(folder.path()),
                           {.pace = Pace::Consumer, .videoBuffers = 2});
    startBoth(player);
    std::optional<Frame> a = player.video().next(milliseconds(0));
    std::optional<Frame> b = player.video().next(milliseconds(0));
    ASSERT_TRUE(a && b);
    EXPECT_FALSE(player.video().next(milliseconds(50)).has_value());
    a.reset();
    EXPECT_EQ(player.video().next(seconds(10))->time().ns, 66 * kMs);
}

TEST(RecordingPlayer, InRealTimeNoPictureIsDeliveredBeforeItsTime) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {5000 * kMs, 5040 * kMs, 5080 * kMs}, {5060 * kMs});
    RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Realtime});
    const Timestamp begin = Timestamp::now();
    startBoth(player);
    while (!player.video().ended()) {
        const std::optional<Frame> frame = player.video().next(seconds(10));
        if (!frame) continue;
        EXPECT_GE((Timestamp::now() - begin).count(), frame->time().ns - 5000 * kMs);
        EXPECT_GE(player.now(), frame->time());
    }
    EXPECT_EQ(player.stills().next(seconds(10))->time().ns, 5060 * kMs);
}

TEST(RecordingPlayer, InRealTimeWaitingForAPictureTimesOutBeforeItIsDue) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 600'000 * kMs}, {});
    RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Realtime});
    startBoth(player);
    EXPECT_TRUE(player.video().next(seconds(10)).has_value());
    EXPECT_FALSE(player.video().next(milliseconds(10)).has_value());
    EXPECT_FALSE(player.video().ended());
    EXPECT_TRUE(player.video().isEarly());
}

TEST(RecordingPlayer, NoFrameIsEarlyAtConsumerPaceOrAfterTheLastOne) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 600'000 * kMs}, {});
    RecordingPlayer consumer(loadRecording(folder.path()), {.pace = Pace::Consumer});
    EXPECT_FALSE(consumer.video().isEarly());
    const TempFolder single;
    writeSmallRecording(single.path(), {0}, {});
    RecordingPlayer player(loadRecording(single.path()), {.pace = Pace::Realtime});
    startBoth(player);
    EXPECT_TRUE(player.video().next(seconds(10)).has_value());
    EXPECT_FALSE(player.video().isEarly());
}

TEST(RecordingPlayer, InRealTimeLatePicturesAreSkippedAndCounted) {
    const TempFolder folder;
    std::vector<std::int64_t> times;
    for (int i = 0; i < 20; ++i)
        times.push_back(i * kMs);
    writeSmallRecording(folder.path(), times, {});
    RecordingPlayer player(loadRecording(folder.path()),
                           {.pace = Pace::Realtime, .videoBuffers = 2});
    startBoth(player);
    std::this_thread::sleep_for(milliseconds(60));
    std::size_t given = 0;
    Timestamp last{-1};
    while (!player.video().ended())
        if (const auto frame = player.video().next(seconds(10))) {
            EXPECT_GT(frame->time(), last);
            last = frame->time();
            ++given;
        }
    EXPECT_EQ(last.ns, 19 * kMs);
    EXPECT_GT(player.skipped(), 0U);
    EXPECT_EQ(given + player.skipped(), 20U);
}

TEST(RecordingPlayer, InRealTimeAWaitingFrameIsSkippedIfANewerOneIsDue) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 100 * kMs, 200 * kMs, 300 * kMs, 600'000 * kMs}, {});
    RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Realtime});
    startBoth(player);
    std::this_thread::sleep_for(milliseconds(450));  // four frames are decoded and due
    const auto frame = player.video().next(seconds(10));
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->time().ns, 300 * kMs);
    EXPECT_EQ(player.video().cameraCounters().delivered, 1U);
    EXPECT_EQ(player.video().cameraCounters().missed, 3U);
}

TEST(RecordingPlayer, StopWakesAWaitingThread) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 600'000 * kMs}, {});
    RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Realtime});
    startBoth(player);
    EXPECT_TRUE(player.video().next(seconds(10)).has_value());
    std::thread stopper([&] { player.video().stop(); });
    EXPECT_FALSE(player.video().next(seconds(600)).has_value());
    stopper.join();
    EXPECT_TRUE(player.video().ended());
    EXPECT_THROW(player.video().start(), std::runtime_error);
}

TEST(RecordingPlayer, TimesIncreaseInALoopAndCanBeMappedToRecordedTimes) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {1000 * kMs, 1500 * kMs}, {1200 * kMs});
    RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Consumer, .loop = true});
    startBoth(player);
    // A loop lasts 500 ms plus 1/30 s.
    EXPECT_EQ(played(player, 7), "V1000=0 S1200=0 V1500=10 V1533=0 S1733=0 V2033=10 V2066=0 ");
    EXPECT_FALSE(player.video().ended());
    EXPECT_EQ(player.recordedTime({1'200 * kMs}).ns, 1200 * kMs);
    EXPECT_EQ(player.recordedTime({1'733'333'333}).ns, 1200 * kMs);
}

TEST(RecordingPlayer, ADamagedPictureIsReportedOnceAndPlayingContinues) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 33 * kMs, 66 * kMs}, {});
    const auto file = folder / "cam0/data/33000000.png";
    std::string bytes = test::readFile(file);
    bytes[bytes.find("IDAT") + 6] ^= 0x55;
    test::writeFile(file, bytes);
    RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Consumer});
    startBoth(player);
    EXPECT_EQ(player.video().next(seconds(10))->time().ns, 0);
    try {
        static_cast<void>(player.video().next(seconds(10)));
        FAIL() << "a damaged picture was played";
    } catch (const RecordingError& e) {
        EXPECT_TRUE(std::string(e.what()).starts_with(file.string() + ": ")) << e.what();
    }
    EXPECT_EQ(player.video().next(seconds(10))->time().ns, 66 * kMs);
    EXPECT_TRUE(player.video().ended());
}

TEST(RecordingPlayer, FramesOutliveThePlayer) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 33 * kMs}, {});
    std::optional<Frame> frame;
    {
        RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Consumer});
        startBoth(player);
        EXPECT_TRUE(player.video().next(seconds(10)).has_value());
        frame = player.video().next(seconds(10));
    }
    EXPECT_EQ(frame->view().data[0], 10);
}

TEST(RecordingPlayer, TheTriggerOfARecordingOnlyCountsPulses) {
    const TempFolder folder;
    writeSmallRecording(folder.path(), {0, 33 * kMs}, {});
    RecordingPlayer player(loadRecording(folder.path()), {.pace = Pace::Consumer});
    startBoth(player);
    static_cast<void>(player.video().next(seconds(10)));
    static_cast<void>(player.video().next(seconds(10)));
    EXPECT_EQ(player.trigger().fire().ns, 33 * kMs);
    EXPECT_EQ(player.trigger().fired(), 1U);
    EXPECT_FALSE(player.stills().next(milliseconds(0)).has_value());
    EXPECT_TRUE(player.stills().ended());
}

TEST(RecordingPlayer, ReportsTheCamerasProperties) {
    const TempFolder folder;
    writeSmallRecording(folder.path());
    RecordingPlayer player(loadRecording(folder.path()), {});
    EXPECT_EQ(player.video().info().size, test::kSmallVideo);
    EXPECT_EQ(player.video().info().rateHz, 30);
    EXPECT_EQ(player.stills().info().size, test::kSmallStill);
    EXPECT_EQ(player.stills().info().rateHz, 0);
    EXPECT_THROW(RecordingPlayer(loadRecording(folder.path()), {.videoBuffers = 1}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace mfar
