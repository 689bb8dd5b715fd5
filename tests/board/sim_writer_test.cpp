#include "daemon/tools/sim_writer.h"
#include "hal/virtual/recording.h"
#include "tests/board/board_support.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace mfar::test {
namespace {

namespace fs = std::filesystem;

TEST(SimWriter, ARecordingIsReadBackWithItsGroundTruth) {
    const TempFolder folder;
    SyntheticBoard board(smallBoard(4));
    int progress = 0;
    const SimCounts counts =
        writeSimulation(board, {folder.path(), 30}, [&](int done) { progress = done; });
    EXPECT_EQ(progress, 4);
    EXPECT_EQ(counts.video, 4);

    const Recording r = loadRecording(folder.path());
    ASSERT_EQ(r.video.size(), 4U);
    ASSERT_EQ(r.poses.size(), 4U);
    ASSERT_EQ(static_cast<int>(r.stills.size()), counts.stills);
    ASSERT_EQ(r.stills.size(), 4U);
    EXPECT_EQ(r.rig.still.size, board.rig().still.size);
    for (std::size_t i = 0; i < 4; ++i) {
        const Timestamp t = r.video[i].time;
        ASSERT_TRUE(r.truthHighRes(t) && r.truthInverseDepth(t));
        const auto pose = r.poseAt(t);
        ASSERT_TRUE(pose);
        EXPECT_LT(
            (pose->T_world_video.translation - board.pose(t).T_world_video.translation).norm(),
            1e-6);
        EXPECT_TRUE(i == 0 || r.truthFlow(r.video[i - 1].time, t));
    }
    EXPECT_EQ(loadImage(*r.truthHighRes(r.video[0].time)).size, board.rig().still.size);
    const auto toStill = r.truthFlow(r.video[3].time, r.stills[1].time);
    ASSERT_TRUE(toStill);
    EXPECT_TRUE(std::isfinite(loadFlo(*toStill).at(80, 60)[0]));
    EXPECT_TRUE(fs::exists(folder.path() / "tags.toml"));
}

TEST(SimWriter, WithoutGroundTruthThereIsNoFolderForIt) {
    const TempFolder folder;
    SyntheticBoard board(smallBoard(1));
    SimOptions sim{folder.path()};
    sim.highRes = sim.depth = sim.flow = false;
    EXPECT_EQ(writeSimulation(board, sim, [](int) {}).video, 1);
    EXPECT_FALSE(fs::exists(folder / "truth"));
}

TEST(SimWriter, ANonEmptyFolderIsRefused) {
    const TempFolder folder;
    fs::create_directory(folder.path() / "other");
    SyntheticBoard board(smallBoard(1));
    EXPECT_THROW((void)writeSimulation(board, {folder.path()}, [](int) {}), std::runtime_error);
}

}  // namespace
}  // namespace mfar::test
