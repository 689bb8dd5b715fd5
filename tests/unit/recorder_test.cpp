#include "base/owned_fd.h"
#include "hal/virtual/recorder.h"
#include "hal/virtual/recording.h"
#include "hal/virtual/recording_player.h"
#include "tests/oracle/yuv.h"
#include "tests/unit/padded_picture.h"
#include "tests/unit/same_camera.h"
#include "tests/unit/small_recording.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mfar {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using test::expectSame;
using test::plain;
using test::TempFolder;

StereoRig smallRig() {
    StereoRig rig;
    rig.video = {test::kSmallVideo, 20.25, 21.1, 7.6, 5.3, {0.1, -0.02, 0.001, 0.002, 0.03}};
    rig.still = {test::kSmallStill, 40.1, 41.3, 15.1, 11.7, {}};
    rig.T_still_video.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized());
    rig.T_still_video.translation = {-0.014, 0.001, 0.002};
    return rig;
}

TEST(Recorder, ARecordingPlaysBackUnchanged) {
    const TempFolder folder;
    const StereoRig rig = smallRig();
    const Pose pose{{20}, rig.T_still_video};
    {
        RecorderOptions options;
        options.stillTimeOffset = 0.0123;
        Recorder recorder(folder / "new/run", rig, 29.97, options);
        EXPECT_TRUE(recorder.video(plain(test::kSmallVideo, 11).view(), {10}));
        EXPECT_TRUE(recorder.video(plain(test::kSmallVideo, 22).view(), {20}));
        EXPECT_TRUE(recorder.still(plain(test::kSmallStill, 33, PixelFormat::Gray8).view(), {15}));
        EXPECT_TRUE(recorder.pose(pose));
        recorder.finish();
        EXPECT_EQ(recorder.videoCounts().written, 2U);
        EXPECT_EQ(recorder.stillCounts().written, 1U);
        EXPECT_EQ(recorder.poseCounts().written, 1U);
    }
    const Recording read = loadRecording(folder / "new/run");
    EXPECT_EQ(read.videoRateHz, 29.97);
    EXPECT_EQ(read.stillTimeOffset, 0.0123);
    expectSame(read.rig.video, rig.video);
    expectSame(read.rig.still, rig.still);
    EXPECT_LT(read.rig.T_still_video.rotation.angularDistance(rig.T_still_video.rotation), 1e-12);
    EXPECT_TRUE(read.rig.T_still_video.translation.isApprox(rig.T_still_video.translation, 1e-12));
    ASSERT_EQ(read.poses.size(), 1U);
    EXPECT_LT(read.poses[0].T_world_video.rotation.angularDistance(pose.T_world_video.rotation),
              1e-12);
    EXPECT_EQ(read.poses[0].T_world_video.translation, pose.T_world_video.translation);

    RecordingPlayer player(read, {.pace = Pace::Consumer});
    player.video().start();
    player.stills().start();
    EXPECT_EQ(player.video().next(seconds(10))->view().data[0], 11);
    EXPECT_EQ(player.stills().next(seconds(10))->view().data[0], 33);
    EXPECT_EQ(player.video().next(seconds(10))->view().data[0], 22);
}

TEST(Recorder, PicturesOfEveryFormatAreRecordedWithTheirColours) {
    const TempFolder folder;
    Recorder recorder(folder.path(), smallRig(), 30, {.videoBuffers = 32});
    std::int64_t time = 0;
    std::vector<std::pair<std::unique_ptr<test::PaddedPicture>, ImageView>> taken;
    for (const PixelFormat format : test::kEveryFormat)
        for (const YuvRange range : {YuvRange::Limited, YuvRange::Full}) {
            auto picture = std::make_unique<test::PaddedPicture>(format, test::kSmallVideo, 3);
            const ImageView view = picture->view(YuvMatrix::Bt709, range);
            EXPECT_TRUE(recorder.video(view, {++time}));
            taken.emplace_back(std::move(picture), view);
        }
    recorder.finish();
    for (std::size_t i = 0; i < taken.size(); ++i) {
        const StoredImage read = loadImage(folder / fmt::format("cam0/data/{}.png", i + 1));
        const ImageView& view = taken[i].second;
        ASSERT_EQ(read.size, view.size);
        for (int y = 0; y < view.size.height; ++y)
            for (int x = 0; x < view.size.width; ++x) {
                const auto rgb = twin::rgbAt(view, x, y);
                const std::uint8_t* p = &read.pixels[4UL * (y * view.size.width + x)];
                // Tolerance: interpolated chroma is rounded to 8 bits before it is converted to
                // colour.
                for (std::size_t c = 0; c < 3; ++c)
                    ASSERT_NEAR(p[c], rgb[c], 1.7) << nameOf(view.format) << " " << x << "," << y;
            }
    }
}

TEST(Recorder, ViewsThatCannotBeReadAreRefused) {
    const TempFolder folder;
    Recorder recorder(folder.path(), smallRig(), 30);
    const test::PaddedPicture picture(PixelFormat::Yuv420, test::kSmallVideo, 3);
    ImageView broken = picture.view();
    broken.chroma[1] = {};
    EXPECT_THROW(recorder.video(broken, {1}), std::invalid_argument);
    EXPECT_THROW(savePng(folder / "a.png", broken), std::invalid_argument);
    EXPECT_TRUE(recorder.video(picture.view(), {1}));
    recorder.finish();
    EXPECT_EQ(recorder.videoCounts().written, 1U);
    EXPECT_EQ(recorder.videoCounts().dropped, 0U);
}

TEST(Recorder, PaddedRowsAreRecordedWithoutThePadding) {
    const TempFolder folder;
    const auto [width, height] = test::kSmallVideo;
    const std::size_t stride = width * 4 + 12;
    std::vector<std::uint8_t> bytes(stride * height, 200);
    for (int y = 0; y < height; ++y)
        std::fill_n(&bytes[y * stride], width * 4, static_cast<std::uint8_t>(y));
    Recorder recorder(folder.path(), smallRig(), 30);
    recorder.video({bytes.data(), test::kSmallVideo, stride, PixelFormat::Rgba8}, {1});
    recorder.finish();
    const StoredImage read = loadImage(folder / "cam0/data/1.png");
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            ASSERT_EQ(read.pixels[(y * width + x) * 4], y);
}

std::set<fs::path> threads() {
    std::set<fs::path> out;
    for (const auto& entry : fs::directory_iterator("/proc/self/task"))
        out.insert(entry.path().filename());
    return out;
}

TEST(Recorder, IfTheDiskHangsPicturesAreDroppedAndCountedWithoutDelayingTheCaller) {
    const TempFolder folder;
    const std::set<fs::path> before = threads();
    Recorder recorder(folder.path(), smallRig(), 30, {.videoBuffers = 4, .poses = 3});
    // A pipe without a reader replaces the first file of each of the recorder's threads. So open()
    // blocks, as on a hanging disk.
    std::vector<fs::path> pipes;
    for (const fs::path& thread : threads())
        if (!before.contains(thread)) {
            pipes.push_back(folder / fmt::format("cam0/data/0.png.{}.part", thread.string()));
            ASSERT_EQ(mkfifo(pipes.back().c_str(), 0600), 0);
        }
    int taken = 0;
    for (int i = 0; i < 20; ++i)
        taken += recorder.video(plain(test::kSmallVideo, 1).view(), {i}) ? 1 : 0;
    EXPECT_EQ(taken, 4);
    EXPECT_EQ(recorder.videoCounts().dropped, 16U);
    EXPECT_EQ(recorder.videoCounts().written, 0U);
    int poses = 0;
    for (int i = 0; i < 5; ++i)
        poses += recorder.pose({{i}, {}}) ? 1 : 0;
    EXPECT_EQ(poses, 3);
    EXPECT_EQ(recorder.poseCounts().dropped, 2U);

    std::vector<OwnedFd> readers;
    for (const fs::path& pipe : pipes)
        readers.emplace_back(open(pipe.c_str(), O_RDWR));
    recorder.finish();
    EXPECT_EQ(recorder.videoCounts().written, 4U);
    EXPECT_EQ(recorder.poseCounts().written, 3U);
}

TEST(Recorder, APatientRecorderWaitsForABufferAndLosesNoPicture) {
    const TempFolder folder;
    Recorder recorder(folder.path(), smallRig(), 30,
                      {.videoBuffers = 1, .patience = std::chrono::minutes(1)});
    for (int i = 0; i < 50; ++i)
        EXPECT_TRUE(recorder.video(plain(test::kSmallVideo, 1).view(), {i}));
    recorder.finish();
    EXPECT_EQ(recorder.videoCounts().written, 50U);
    EXPECT_EQ(recorder.videoCounts().dropped, 0U);
}

TEST(Recorder, AVideoRateOfZeroIsRefusedBeforeAFolderIsCreated) {
    const TempFolder folder;
    EXPECT_THROW(Recorder(folder / "run", smallRig(), 0), std::runtime_error);
    EXPECT_FALSE(fs::exists(folder / "run"));
}

TEST(Recorder, FullDiskIsReportedAndEndsTheRecording) {
    const TempFolder folder;
    Recorder recorder(folder.path(), smallRig(), 30);
    const fs::path list = folder / "cam1/data.csv";
    fs::remove(list);
    fs::create_symlink("/dev/full", list);
    EXPECT_TRUE(recorder.still(plain(test::kSmallStill, 1).view(), {1}));
    const std::string expected = list.string() + ": No space left on device";
    try {
        recorder.finish();
        FAIL() << "a write error was lost";
    } catch (const std::runtime_error& e) {
        EXPECT_EQ(e.what(), expected);
    }
    EXPECT_EQ(recorder.error(), expected);
    EXPECT_FALSE(recorder.video(plain(test::kSmallVideo, 1).view(), {2}));
    EXPECT_EQ(recorder.videoCounts().dropped, 1U);
    EXPECT_THROW(recorder.finish(), std::runtime_error);
}

TEST(Recorder, APictureIsListedOnlyWhenItsFileIsComplete) {
    const TempFolder folder;
    Recorder recorder(folder.path(), smallRig(), 30);
    EXPECT_TRUE(recorder.video(plain(test::kSmallVideo, 1).view(), {1}));
    recorder.finish();
    fs::remove_all(folder / "cam0/data");
    EXPECT_TRUE(recorder.video(plain(test::kSmallVideo, 1).view(), {2}));
    EXPECT_THROW(recorder.finish(), std::runtime_error);
    EXPECT_EQ(test::readFile(folder / "cam0/data.csv"), "#timestamp [ns],filename\n1,1.png\n");
}

TEST(Recorder, PicturesThatWouldMakeTheRecordingInvalidAreRefused) {
    const TempFolder folder;
    Recorder recorder(folder.path(), smallRig(), 30);
    const StoredImage picture = plain(test::kSmallVideo, 1);
    EXPECT_FALSE(recorder.video(picture.view(), {-1}));
    EXPECT_TRUE(recorder.video(picture.view(), {100}));
    EXPECT_FALSE(recorder.video(picture.view(), {100}));
    EXPECT_FALSE(recorder.video(picture.view(), {99}));
    EXPECT_FALSE(recorder.video(plain(test::kSmallStill, 1).view(), {101}));
    Pose pose{{1}, {}};
    pose.T_world_video.translation.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(recorder.pose(pose));
    EXPECT_EQ(recorder.videoCounts().dropped, 4U);
    EXPECT_EQ(recorder.poseCounts().dropped, 1U);
    recorder.finish();
    EXPECT_EQ(loadRecording(folder.path()).video.size(), 1U);
}

TEST(Recorder, ANonEmptyFolderIsRefused) {
    const TempFolder folder;
    test::writeFile(folder / "precious", "x");
    EXPECT_THROW(Recorder(folder.path(), smallRig(), 30), std::runtime_error);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
    EXPECT_THROW(Recorder(folder / "precious/sub", smallRig(), 30), std::runtime_error);
}

}  // namespace
}  // namespace mfar
