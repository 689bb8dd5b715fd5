#include "daemon/status.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::vector<StageTime> kStages = {{"flow", 30}, {"superres", 10}};

/// Shows pictures every 50 ms, each 20 ms after its frame's arrival. The 21st is shown at 11.02 s.
void showPictures(Stats& stats, int count) {
    for (int i = 0; i < count; ++i) {
        FrameStats frame;
        frame.tiles = {100, 0, 50, 50};
        frame.meanConfidence = 0.8;
        frame.usedStill = i >= count / 2;
        frame.usedPose = frame.usedStill;
        frame.searched2d = frame.usedPose ? 3 : 0;
        frame.matchedSecond = frame.usedStill ? 5 : 0;
        frame.showSecond = frame.usedStill ? 4 : 0;
        const Timestamp arrived = Timestamp::fromSeconds(10 + 0.05 * i);
        stats.picture({frame, kStages, arrived, arrived + std::chrono::milliseconds(20), 1.5});
    }
}

TEST(Stats, RatesLatencyAndSharesAreComputedFromTheShownPictures) {
    Stats stats;
    showPictures(stats, 21);
    const Counted counted = stats.count(Timestamp::fromSeconds(11.05));
    EXPECT_EQ(counted.frames, 21U);
    EXPECT_NEAR(counted.fps, 20, 1e-6);
    EXPECT_NEAR(counted.recentFps, 20, 1e-6);
    EXPECT_NEAR(counted.latencyMs.quantile(0.5), 20, 0.3);
    EXPECT_NEAR(counted.meanConfidence, 0.8, 1e-9) << "frames without a still must not count";
}

TEST(Stats, WithoutShownPicturesAllValuesAreZero) {
    Stats stats;
    const Counted counted = stats.count();
    EXPECT_EQ(counted.fps, 0);
    EXPECT_EQ(counted.recentFps, 0);
    EXPECT_EQ(counted.meanConfidence, 0);
}

TEST(Stats, RecentRateFallsWhenPicturesStop) {
    Stats stats;
    showPictures(stats, 21);
    const auto fpsAt = [&](double s) { return stats.count(Timestamp::fromSeconds(s)).recentFps; };
    EXPECT_NEAR(fpsAt(11.07), 20, 1e-6) << "the rate may fall only once a picture is overdue";
    EXPECT_NEAR(fpsAt(11.12), 10, 1e-6);
    EXPECT_NEAR(fpsAt(21.02), 0.1, 1e-6);
    EXPECT_LT(fpsAt(1000), 0.01);
}

// Regression test: the rate was 0 if it was read more often than pictures were made.
TEST(Stats, RecentRateOfSlowPicturesIsRightAtAnyTime) {
    Stats stats;
    for (int i = 0; i < 4; ++i) {
        const Timestamp shown = Timestamp::fromSeconds(10 + 2.5 * i);
        stats.picture({{}, kStages, shown, shown, {}});
    }
    for (const double s : {17.6, 17.7, 18.5, 19.9})
        EXPECT_NEAR(stats.count(Timestamp::fromSeconds(s)).recentFps, 0.4, 1e-6) << s;
}

TEST(Stats, RecentRateCoversTheLastSecond) {
    Stats stats;
    const auto show = [&](double s) {
        const Timestamp shown = Timestamp::fromSeconds(s);
        stats.picture({{}, kStages, shown, shown, {}});
    };
    for (int i = 0; i < 300; ++i)
        show(10 + 0.01 * i);
    EXPECT_NEAR(stats.count(Timestamp::fromSeconds(13)).recentFps, 100, 1e-3);
    for (int i = 0; i < 20; ++i)
        show(13 + 0.1 * i);
    EXPECT_NEAR(stats.count(Timestamp::fromSeconds(15)).recentFps, 10, 1e-3);
}

TEST(Status, TheSummaryContainsTheMeasurementsOfTheRun) {
    Stats stats;
    showPictures(stats, 21);
    stats.stillReceived({});
    stats.stillUsed();
    stats.triggers(3, 2, std::nullopt);
    stats.mailboxDropped(4);
    CameraState video;
    video.counters.missed = 5;
    stats.camera(CameraRole::Video, video);
    stats.recorderDropped(6);
    stats.firstPicture({431.6, 380, 90.4});
    const auto json = summary(
        stats.count(), {"llvmpipe", "synthetic", "none", "detail", {}, {}, "2 tags"}, "SIGTERM", 0);
    EXPECT_EQ(json["exit_reason"], "SIGTERM");
    EXPECT_EQ(json["exit_code"], 0);
    EXPECT_EQ(json["renderer"], "llvmpipe");
    EXPECT_EQ(json["frames"], 21);
    EXPECT_NEAR(json["stage_ms"]["flow"]["median"].get<double>(), 30, 0.5);
    EXPECT_NEAR(json["stage_ms"]["superres"]["p99"].get<double>(), 10, 0.2);
    EXPECT_DOUBLE_EQ(json["tile_share"]["unchanged"].get<double>(), 0.5);
    EXPECT_DOUBLE_EQ(json["tile_share"]["trusted"].get<double>(), 0.25);
    EXPECT_EQ(json["stills"]["triggered"], 3);
    EXPECT_EQ(json["stills"]["received"], 1);
    EXPECT_EQ(json["stills"]["lost"], 2);
    EXPECT_EQ(json["stills"]["tiles_matched_second"], 55)
        << "5 tiles in each of 11 frames with a still";
    EXPECT_EQ(json["stills"]["tiles_show_second"], 44);
    EXPECT_EQ(json["drops"]["mailbox"], 4);
    EXPECT_EQ(json["drops"]["sensor"], 5);
    EXPECT_EQ(json["drops"]["recorder"], 6);
    EXPECT_EQ(json["first_picture"]["since_start_ms"], 431.6);
    EXPECT_EQ(json["first_picture"]["cpu_ms"], 380);
    EXPECT_EQ(json["first_picture"]["resident_mb"], 90.4);
}

TEST(Status, ReportsTheStateOfTheCameras) {
    Stats stats;
    CameraState video;
    video.configuredHz = 30;
    video.rateHz = 14.9;
    video.lastFrame = Timestamp::now();
    video.lastDistinct = Timestamp::now() - std::chrono::seconds(7);
    video.repeated = 6;
    video.counters = {.delivered = 100,
                      .missed = 5,
                      .broken = 1,
                      .badTimes = 2,
                      .startup = 3,
                      .untimed = 4,
                      .restarts = 8,
                      .reopened = 9};
    stats.camera(CameraRole::Video, video);
    StillCounters line;
    line.overtaken = 3;
    line.missedEdges = 4;
    stats.matching(line);
    const auto json = summary(stats.count(), {}, "", 0);
    const auto camera = json["cameras"]["video"];
    EXPECT_EQ(camera["configured_hz"], 30);
    EXPECT_EQ(camera["measured_hz"], 14.9);
    EXPECT_EQ(camera["delivered"], 100);
    EXPECT_EQ(camera["missed"], 5);
    EXPECT_EQ(camera["broken"], 1);
    EXPECT_EQ(camera["bad_times"], 2);
    EXPECT_EQ(camera["startup"], 3);
    EXPECT_EQ(camera["untimed"], 4);
    EXPECT_EQ(camera["restarts"], 8);
    EXPECT_EQ(camera["reopened"], 9);
    EXPECT_EQ(camera["repeated_pictures"], 6);
    EXPECT_NEAR(camera["distinct_age_s"].get<double>(), 7, 1);
    EXPECT_FALSE(json["cameras"]["still"].contains("missed"))
        << "no count of missed stills may be reported";
    EXPECT_FALSE(json["cameras"]["still"].contains("distinct_age_s"));
    EXPECT_EQ(json["trigger_line"]["overtaken"], 3);
    EXPECT_EQ(json["trigger_line"]["missed_edges"], 4);
    EXPECT_EQ(json["drops"]["sensor"], 5);
}

TEST(Status, TheRateOfASilentCameraIsZero) {
    Stats stats;
    CameraState video;
    video.rateHz = 30;
    video.lastFrame = Timestamp::now() - std::chrono::seconds(3);
    stats.camera(CameraRole::Video, video);
    EXPECT_EQ(stats.count().cameras[0].rateHz, 0);
}

TEST(Status, ReportsTheTimeOfTheFirstPicture) {
    EXPECT_EQ(firstPictureLine({431.6, 380, 90.4}),
              "first picture 432 ms after the start, 90 MB resident");
    EXPECT_EQ(
        firstPictureLine({431.6, 380, 90.4}, "no screen yet (kms: there is no card0)"),
        "first picture drawn 432 ms after the start, 90 MB resident, but not shown: no screen "
        "yet (kms: there is no card0)");
}

TEST(Status, TheLastLineHasARateOnlyWithTwoPictures) {
    EXPECT_EQ(endLine(0, 0, 0, "SIGTERM"), "0 pictures: SIGTERM");
    EXPECT_EQ(endLine(1, 0, 0, "end of the source"), "1 picture: end of the source");
    EXPECT_EQ(endLine(2, 0.0279, 35.9, "SIGINT"), "2 pictures in 0.03 s, 35.9 fps: SIGINT");
}

TEST(Status, ReportsTheShareOfFramesWithinTheDeadline) {
    Stats stats;
    showPictures(stats, 2);
    EXPECT_EQ(summary(stats.count(), {}, "", 0)["quality"]["frames_of_level"].size(), 0U);
    EXPECT_THAT(statusLine(stats.count(), {}, 1), Not(HasSubstr("quality")));
    const auto show = [&](double ms) { stats.picture({{}, kStages, {}, {}, {}, ms}); };
    stats.quality("fast", 33);
    for (int i = 0; i < 18; ++i)
        show(20);
    stats.quality("best", 33);
    show(30);
    show(40);
    const auto quality = summary(stats.count(), {}, "", 0)["quality"];
    EXPECT_EQ(quality["deadline_ms"], 33);
    EXPECT_EQ(quality["late"], 1);
    EXPECT_EQ(quality["frames_of_level"]["fast"], 18);
    EXPECT_EQ(quality["frames_of_level"]["best"], 2);
    EXPECT_NEAR(quality["frame_ms"]["median"].get<double>(), 20, 0.3);
    EXPECT_NEAR(quality["frame_ms"]["p95"].get<double>(), 30, 0.4);
    EXPECT_THAT(statusLine(stats.count(), {}, 1), HasSubstr(", quality best (5% late)"));
    stats.quality("best", 0);
    EXPECT_THAT(statusLine(stats.count(), {}, 1), HasSubstr(", quality best,"));
}

Pose fromTags(int tags, double errorPx) {
    Pose pose;
    pose.tags = tags;
    pose.reprojectionError = errorPx;
    return pose;
}

/// Adds three frames: with a measured pose, with a predicted pose and without a pose. Adds two
/// stills: with a measured pose and with a pose that was interpolated between frames.
void findPoses(Stats& stats) {
    TrackStats tracker{.frames = 3, .fullSearches = 1, .roiSearches = 2, .flips = 4, .lastMs = 2};
    stats.framePose(fromTags(6, 0.25), tracker);
    stats.framePose(Pose{}, tracker);
    stats.framePose({}, tracker);
    stats.stillPose(fromTags(5, 0.1), 8.);
    stats.stillPose(Pose{}, 8.);
}

TEST(Status, SummaryReportsTheSourcesOfPoses) {
    Stats stats;
    showPictures(stats, 4);
    findPoses(stats);
    RunDescription run;
    run.poses = "2 tags";
    const auto pose = summary(stats.count(), run, "", 0)["pose"];
    EXPECT_EQ(pose["from"], "2 tags");
    EXPECT_EQ(pose["asked"], 3);
    EXPECT_EQ(pose["tracked"], 2);
    EXPECT_EQ(pose["measured"], 1);
    EXPECT_NEAR(pose["tracked_share"].get<double>(), 2. / 3, 1e-9);
    EXPECT_EQ(pose["epipolar_frames"], 2) << "2 frames were matched along lines";
    EXPECT_EQ(pose["tiles_searched_2d"], 6) << "3 tiles in each of these 2 frames";
    EXPECT_EQ(pose["tags"], 6) << "frames without tags do not count";
    EXPECT_EQ(pose["reprojection_px"], 0.25);
    EXPECT_EQ(pose["full_searches"], 1);
    EXPECT_EQ(pose["roi_searches"], 2);
    EXPECT_EQ(pose["flips"], 4);
    EXPECT_NEAR(pose["track_ms"]["median"].get<double>(), 2, 0.05);
    EXPECT_EQ(pose["stills_asked"], 2);
    EXPECT_EQ(pose["stills_tracked"], 2);
    EXPECT_EQ(pose["stills_measured"], 1);
    EXPECT_NEAR(pose["still_track_ms"]["median"].get<double>(), 8, 0.1);
}

/// Shows three frames that were matched along epipolar lines: the first without an epipolar error,
/// the second with a refined pose, the third with a predicted pose.
void showLines(Stats& stats) {
    FrameStats frame;
    frame.usedStill = frame.usedPose = true;
    const auto show = [&] { stats.picture({frame, kStages, {}, {}, 1.5}); };
    show();
    frame.posePatches = 200;
    frame.refinedPose = true;
    frame.epipolarError = 0.1;
    show();
    frame.refinedPose = false;
    frame.predicted = true;
    frame.epipolarError = 0.2;
    show();
}

TEST(Status, ReportsTheEpipolarError) {
    Stats stats;
    EXPECT_EQ(summary(stats.count(), {}, "", 0)["pose"]["epipolar_px"], 0);
    showLines(stats);
    const auto pose = summary(stats.count(), {}, "", 0)["pose"];
    EXPECT_EQ(pose["epipolar_frames"], 3);
    EXPECT_EQ(pose["refined_frames"], 1);
    EXPECT_EQ(pose["predicted_frames"], 1);
    EXPECT_NEAR(pose["epipolar_px"].get<double>(), 0.15, 1e-9);
    EXPECT_THAT(statusLine(stats.count(), {}, 1), HasSubstr(", epipolar error 0.20 px |"));
    stats.picture({{.usedStill = true, .usedPose = true}, kStages, {}, {}, 1.5});
    EXPECT_THAT(statusLine(stats.count(), {}, 1), Not(HasSubstr("epipolar")));
}

TEST(Status, LineReportsTheSourceOfTheLastPose) {
    Stats stats;
    showPictures(stats, 2);
    EXPECT_THAT(statusLine(stats.count(), {}, 1), Not(HasSubstr("tracked")))
        << "without poses the line must not mention tracking";
    const TrackStats tracker{.frames = 1, .lastMs = 2};
    stats.framePose(fromTags(6, 0.25), tracker);
    EXPECT_THAT(statusLine(stats.count(), {}, 1),
                HasSubstr(", tracked 100% (6 tags, 0.25 px, 2.0 ms) |"));
    stats.framePose(Pose{}, tracker);
    EXPECT_THAT(statusLine(stats.count(), {}, 1), HasSubstr("100% (no tag, predicted, 2.0 ms)"));
    stats.framePose({}, tracker);
    EXPECT_THAT(statusLine(stats.count(), {}, 1), HasSubstr("67% (no tag, 2.0 ms)"));
    Stats recorded;
    showPictures(recorded, 2);
    recorded.framePose(Pose{}, {});
    EXPECT_THAT(statusLine(recorded.count(), {}, 1), HasSubstr(", tracked 100% |"));
}

TEST(Status, SummaryOfAnEmptyRunContainsNoNull) {
    Stats stats;
    const auto json = summary(stats.count(), {}, "error", 70);
    EXPECT_EQ(json.dump().find("null"), std::string::npos) << json.dump();
}

TEST(Status, LineShowsTheLastFrame) {
    Stats stats;
    showPictures(stats, 21);
    const std::string line = statusLine(stats.count(Timestamp::fromSeconds(11.05)), {}, 1);
    EXPECT_THAT(line,
                AllOf(HasSubstr("20.0 fps"), HasSubstr("flow 30.0"), HasSubstr("confidence 0.80"),
                      HasSubstr("still 1.5 s"), HasSubstr("unchanged 50%"), HasSubstr("0 dropped"),
                      Not(HasSubstr("hidden"))));
    EXPECT_THAT(line, Not(HasSubstr("["))) << "there must be no bar if the end is unknown";
}

TEST(Status, LineBeginsWithFaults) {
    Stats stats;
    showPictures(stats, 2);
    Health health{HealthState::Stalled, "the capture thread hangs", 5.2, 5.3, "capture"};
    EXPECT_THAT(statusLine(stats.count(), {}, 1, health),
                testing::StartsWith("the capture thread hangs (stalled for 5.2 s, last picture 5.3 "
                                    "s ago) | "));
}

TEST(Status, LineReportsThatNoFrameHasArrived) {
    Stats stats;
    EXPECT_EQ(statusLine(stats.count(), {}, 1), "waiting for the first picture");
}

TEST(Status, LineHasAProgressBarIfTheEndIsKnown) {
    Stats stats;
    showPictures(stats, 20);
    RunDescription run;
    run.plannedFrames = 40;
    EXPECT_THAT(statusLine(stats.count(), run, 1), testing::StartsWith("[########........]  50% "));
    run.plannedFrames.reset();
    run.plannedPictures = 80;
    EXPECT_THAT(statusLine(stats.count(), run, 1), testing::StartsWith("[####............]  25%"));
    run.plannedPictures.reset();
    run.plannedSeconds = 4;
    EXPECT_THAT(statusLine(stats.count(), run, 1), testing::StartsWith("[####............]  25%"));
}

TEST(Summary, ReportsThePathTracerOnlyIfThereIsOne) {
    Stats stats;
    EXPECT_FALSE(summary(stats.count(), {}, "", 0)["virtual"].contains("path_tracer"));
    TracedLayerCounters counters;
    counters.render.samples = 123456;
    counters.render.shownSince = Timestamp::fromSeconds(3);
    counters.warped = 7;
    stats.traced(counters, Timestamp::fromSeconds(3.5));
    FrameStats frame;
    frame.objectsInView = true;
    const std::vector<StageTime> stages;
    stats.picture({frame, stages, {}, {}, {}});
    frame.objectsHidden = true;
    stats.picture({frame, stages, {}, {}, {}});
    const auto json = summary(stats.count(), {}, "", 0)["virtual"];
    EXPECT_EQ(json["frames_in_view"], 2);
    EXPECT_EQ(json["frames_hidden"], 1);
    EXPECT_EQ(json["path_tracer"]["samples"], 123456);
    EXPECT_EQ(json["path_tracer"]["frames_warped"], 7);
    EXPECT_NEAR(json["path_tracer"]["reference_age_s"].get<double>(), 0.5, 1e-9);
}

TEST(StatusLine, TheStatusLineReportsTheProgressOfPathTracing) {
    Stats stats;
    FrameStats frame;
    frame.objectsInView = true;
    const std::vector<StageTime> stages;
    stats.picture({frame, stages, {}, {}, {}});
    TracedLayerCounters counters;
    counters.render.idle = false;
    counters.render.progress = 0.4;
    counters.openHoles = 12;
    stats.traced(counters, {});
    const std::string busy = statusLine(stats.count(), {}, 0);
    EXPECT_NE(busy.find("path tracing 40%"), std::string::npos) << busy;
    EXPECT_NE(busy.find("12 pixels missing"), std::string::npos) << busy;
    counters.render.idle = true;
    counters.openHoles = 0;
    stats.traced(counters, {});
    const std::string done = statusLine(stats.count(), {}, 0);
    EXPECT_NE(done.find(", path traced"), std::string::npos) << done;
    EXPECT_EQ(done.find("missing"), std::string::npos) << done;
}

}  // namespace
}  // namespace mfar
