#include "daemon/tools/calibrate/report.h"
#include "daemon/tools/calibrate/residual_picture.h"
#include "hal/virtual/image_files.h"
#include "tests/calibration/synthetic_views.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace mfar::test {
namespace {

using namespace calibration;

const Target kGrid = aprilGrid(6, 6, 0.064, 0.25);

void expectCamera(const SensorResult& found, const CameraModel& truth) {
    const CameraModel& c = found.camera;
    EXPECT_NEAR(c.fx, truth.fx, 1e-3 * truth.fx);
    EXPECT_NEAR(c.fy, truth.fy, 1e-3 * truth.fy);
    EXPECT_NEAR(c.cx, truth.cx, 0.5);
    EXPECT_NEAR(c.cy, truth.cy, 0.5);
    EXPECT_LT(std::abs(c.fx - truth.fx), 4 * found.deviations[0]);
    EXPECT_LT(std::abs(c.cx - truth.cx), 4 * found.deviations[2]);
    EXPECT_LT(std::abs(c.distortion[0] - truth.distortion[0]), 4 * found.deviations[4]);
}

void expectRig(const Calibration& found, const StereoRig& truth = trueRig()) {
    expectCamera(found.video, truth.video);
    expectCamera(found.still, truth.still);
    const RigidTransform &T = found.rig.rig.T_still_video, &E = truth.T_still_video;
    EXPECT_NEAR(T.translation.norm(), E.translation.norm(), 0.01 * E.translation.norm());
    EXPECT_LT((T.translation - E.translation).norm(),
              4 * found.extrinsicDeviations.tail<3>().norm());
    EXPECT_LT(T.rotation.angularDistance(E.rotation),
              4 * found.extrinsicDeviations.head<3>().norm());
}

TEST(Calibrate, FindsLensesBaselineAndClockOffsetInNoise) {
    Motion motion;
    motion.offset = 0.0123;
    const BothViews views = makeViews(kGrid, motion);
    const Calibration found = calibrate(kGrid, views.video, views.still, {});
    expectRig(found);
    ASSERT_TRUE(found.offsetKnown);
    EXPECT_NEAR(found.rig.stillTimeOffset, motion.offset, 4 * found.offsetDeviation);
    EXPECT_LT(found.offsetDeviation, 0.0002);
    EXPECT_NEAR(found.video.rms, motion.noise * std::sqrt(2), 0.02);
    EXPECT_NEAR(found.still.rms, motion.noise * std::sqrt(2), 0.02);
}

TEST(Calibrate, TiltedViewsOfAWideLensAreUsed) {
    Motion motion;
    motion.tilt = 0.8;
    motion.aside = 0.3;
    motion.distance = 0.5;
    const BothViews views = makeViews(kGrid, motion, wideRig());
    const Calibration found = calibrate(kGrid, views.video, views.still, {});
    expectRig(found, wideRig());
    for (const SensorResult* sensor : {&found.video, &found.still})
        for (const ViewResult& view : sensor->views)
            EXPECT_TRUE(view.used || view.corners.size() < 20) << view.time.seconds();
}

TEST(Calibrate, ClockOffsetsOfManyFrameIntervalsAreFound) {
    Motion motion;
    motion.offset = -0.187;
    const BothViews views = makeViews(kGrid, motion);
    const Calibration found = calibrate(kGrid, views.video, views.still, {});
    EXPECT_NEAR(found.rig.stillTimeOffset, motion.offset, 0.0003);
    expectRig(found);
}

TEST(Calibrate, AClockOffsetBeyondTheSearchRangeIsRefused) {
    // The largest accepted offset is 0.25 s. With -0.4 s, the stills nearly fit the video; -0.6 s
    // distorts the poses; 0.7 s looks like a smaller offset.
    for (const double offset : {-0.4, -0.6, 0.7}) {
        Motion motion;
        motion.offset = offset;
        const BothViews views = makeViews(kGrid, motion);
        EXPECT_THROW((void)calibrate(kGrid, views.video, views.still, {}), Unsuitable) << offset;
    }
}

TEST(Calibrate, ARecordingThatHasLostVideoFramesIsUsed) {
    for (const int every : {3, 4}) {
        BothViews views = makeViews(kGrid, {});
        int frame = 0;
        std::erase_if(views.video.views, [&](const TargetView&) { return ++frame % every == 0; });
        const Calibration found = calibrate(kGrid, views.video, views.still, {});
        expectRig(found);
        EXPECT_GE(found.pairs, 12) << every;
    }
}

TEST(Calibrate, IfOnlyAFewStillsOverlapTheVideoTheyAreNotRejectedAsOutliers) {
    BothViews views = makeViews(kGrid, {});
    // The video sees the target only in the first third of the recording.
    const auto end = views.video.views[views.video.views.size() / 3].time;
    std::erase_if(views.video.views, [&](const TargetView& v) { return v.time > end; });
    const Calibration found = calibrate(kGrid, views.video, views.still, {});
    EXPECT_GE(found.pairs, 6);
    expectRig(found);
}

TEST(Calibrate, WrongCornersAndWrongViewsAreExcluded) {
    BothViews views = makeViews(kGrid, {});
    for (std::size_t i = 0; i < views.video.views.size(); i += 3)
        views.video.views[i].corners[i % 20].pixel.x() += 3 + static_cast<double>(i % 5);
    for (const std::size_t bad : {2U, 9U})
        for (Corner& c : views.still.views[bad].corners)
            c.pixel.y() *= 1.004;
    // The corners of a still with a wrong time fit well but contradict the motion of the video.
    views.still.views[5].time = views.still.views[5].time + std::chrono::milliseconds(60);
    const Calibration found = calibrate(kGrid, views.video, views.still, {});
    expectRig(found);
    for (const ViewResult& view : found.still.views) {
        const bool bad = view.time == views.still.views[2].time ||
                         view.time == views.still.views[9].time ||
                         view.time == views.still.views[5].time;
        EXPECT_EQ(view.used, !bad) << view.time.seconds();
    }
}

void expectNoOffset(const Calibration& found) {
    EXPECT_FALSE(found.offsetKnown);
    EXPECT_EQ(found.rig.stillTimeOffset, 0);
    EXPECT_NE(resultText(found).find("not measured"), std::string::npos);
    expectRig(found);
}

TEST(Calibrate, AnUnobservableClockOffsetIsZeroAndReportedAsNotMeasured) {
    Motion motion;
    motion.rests = true;
    motion.stillsHz = 1;
    motion.seconds = 16;
    const BothViews views = makeViews(kGrid, motion);
    expectNoOffset(calibrate(kGrid, views.video, views.still, {}));
}

TEST(Calibrate, ClockOffsetThatIsNotSearchedIsZero) {
    const BothViews views = makeViews(kGrid, {});
    SolveOptions options;
    options.maxOffset = 0;
    expectNoOffset(calibrate(kGrid, views.video, views.still, options));
}

std::string refusal(const BothViews& views) {
    try {
        static_cast<void>(calibrate(kGrid, views.video, views.still, {}));
    } catch (const Unsuitable& e) {
        return e.what();
    }
    return "accepted";
}

TEST(Calibrate, TooFewViewsAreRefused) {
    BothViews views = makeViews(kGrid, {});
    views.still.views.resize(5);
    EXPECT_EQ(
        refusal(views),
        "too few views: 5 pictures of the still sensor show the target; at least 6 are needed");
    views.video.views.resize(11);
    EXPECT_NE(refusal(views).find("11 pictures of the video sensor"), std::string::npos);
}

TEST(Calibrate, AllViewsFromOneDirectionAreRefused) {
    Motion motion;
    motion.tilt = 0.03;
    EXPECT_NE(refusal(makeViews(kGrid, motion)).find("from nearly one direction"),
              std::string::npos);
}

TEST(Calibrate, AllViewsFromOneDistanceAreRefused) {
    // The target is small and is tilted about its own centre. So all its points have nearly the
    // same depth.
    const Target small = aprilGrid(6, 6, 0.008, 0.25);
    Motion motion;
    motion.distance = 0.02;
    motion.aside = 0.3;
    const BothViews views = makeViews(small, motion);
    try {
        static_cast<void>(calibrate(small, views.video, views.still, {}));
        FAIL() << "calibrate() must refuse these views";
    } catch (const Unsuitable& e) {
        EXPECT_NE(std::string(e.what()).find("nearly one distance"), std::string::npos) << e.what();
    }
}

TEST(Calibrate, ViewsThatLeavePartOfThePictureUncoveredAreRefused) {
    BothViews views = makeViews(kGrid, {});
    for (TargetView& view : views.video.views)
        std::erase_if(view.corners, [](const Corner& c) { return c.pixel.x() > 330; });
    std::erase_if(views.video.views, [](const TargetView& v) { return v.corners.size() < 12; });
    const std::string said = refusal(views);
    EXPECT_NE(said.find("% of the video sensor's picture; at least"), std::string::npos) << said;
    EXPECT_NE(said.find("right"), std::string::npos) << said;
}

TEST(Calibrate, StillsWithoutVideoAreRefused) {
    BothViews views = makeViews(kGrid, {});
    for (TargetView& view : views.still.views)
        view.time = view.time + std::chrono::seconds(1000);
    EXPECT_NE(refusal(views).find("only 0 stills were taken while the video saw"),
              std::string::npos);
}

TEST(Calibrate, TheReportListsEveryViewAndTheResidualPictureIsWritten) {
    const BothViews views = makeViews(kGrid, {});
    const Calibration found = calibrate(kGrid, views.video, views.still, {});
    const std::string text = viewsText(found);
    std::size_t lines = 0;
    for (std::size_t at = text.find(" px"); at != text.npos; at = text.find(" px", at + 1))
        ++lines;
    EXPECT_EQ(lines, found.video.views.size() + found.still.views.size());
    EXPECT_NE(resultText(found).find("mm apart"), std::string::npos);
    const TempFolder folder;
    saveResidualPicture(folder / "residuals.png", found);
    const StoredImage picture = loadImage(folder / "residuals.png");
    EXPECT_GT(picture.size.width, 1000);
    std::size_t coloured = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
        coloured += std::abs(picture.pixels[i] - picture.pixels[i + 2]) > 30 ? 1 : 0;
    EXPECT_GT(coloured, 5000U);  // only arrows and dots are coloured
}

}  // namespace
}  // namespace mfar::test
