#include "base/rows.h"
#include "base/time.h"
#include "hal/device/display_drm.h"
#include "hal/device/display_kms.h"
#include "tests/device/pretended_drm.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

using std::chrono::milliseconds;
using Presence = Screen::Presence;

class KmsScreenTest : public testing::Test {
protected:
    KmsScreenTest() {
        for (int y = 0; y < rows_.size().height; ++y)
            std::fill_n(rows_[y], rows_.size().width, 0xff302010U);
    }

    [[nodiscard]] std::string card() const { return (folder_ / "card").string(); }
    void show() { screen_.show(Picture(rows_.rows())); }
    /// Returns the message of the error that show() throws. `took`: receives the duration of the
    /// call.
    std::string faultOfShow(milliseconds& took) {
        const Timestamp begin = Timestamp::now();
        std::string out;
        try {
            show();
        } catch (const std::runtime_error& error) {
            out = error.what();
        }
        took = std::chrono::duration_cast<milliseconds>(Timestamp::now() - begin);
        return out;
    }

    test::TempFolder folder_;
    test::PretendedDrm& driver_ = test::pretendedDrm(card());
    AlignedRows<std::uint32_t> rows_{{64, 48}};
    ScreenScaler scaler_;
    KmsScreen screen_{{ScreenSpec::Kind::Kms, card(), "", {}}, scaler_};
};

TEST_F(KmsScreenTest, ShowsPicturesAndRestoresTheConsole) {
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    EXPECT_EQ(screen_.size(), (Size{64, 48}));
    show();
    EXPECT_EQ(driver_.modeSets, 1);
    const std::uint32_t first = driver_.shown;
    show();
    show();
    EXPECT_EQ(driver_.modeSets, 1);
    EXPECT_EQ(driver_.flipped, 1) << "the second flip must still be pending";
    EXPECT_EQ(driver_.shown, first) << "the third picture must reuse the first one's buffer";
    for (const std::uint32_t pixel : test::shownPixels())
        ASSERT_EQ(pixel & 0xffffffU, 0x102030U);
    EXPECT_NE(screen_.status().find("HDMI-A-1,64x48@60"), std::string::npos) << screen_.status();
    screen_.close();
    EXPECT_TRUE(driver_.console);
    EXPECT_EQ(driver_.flipped, 2) << "close() must wait for the last flip";
    EXPECT_EQ(driver_.blockingFlips, 0);
    EXPECT_EQ(driver_.buffers, 0);
    EXPECT_EQ(driver_.framebuffers, 0);
}

TEST_F(KmsScreenTest, AFlipThatNeverCompletesIsReportedAfterHalfASecondAndRetried) {
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    show();
    driver_.flips = false;
    show();
    milliseconds took{};
    EXPECT_EQ(faultOfShow(took),
              card() + ", HDMI-A-1: the display driver did not show the new picture in time");
    EXPECT_GE(took, milliseconds(500));
    EXPECT_LT(took, milliseconds(20'000)) << "the wait must end despite other events";
    screen_.close();
    test::pretendedDrm(card());
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    show();
    show();
    EXPECT_EQ(driver_.modeSets, 1);
}

TEST_F(KmsScreenTest, OtherEventsDoNotCompleteAFlip) {
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    show();
    show();
    driver_.otherEvents = 3;
    show();
    EXPECT_EQ(driver_.flipped, 1);
    EXPECT_EQ(driver_.otherEvents, 0);
}

TEST_F(KmsScreenTest, ARefusedFlipIsReportedWithScreenAndReason) {
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    show();
    driver_.refusesFlips = true;
    milliseconds took{};
    EXPECT_EQ(faultOfShow(took),
              card() +
                  ", HDMI-A-1: the display driver refuses the picture: Device or resource busy");
}

TEST_F(KmsScreenTest, ATooSmallDumbBufferIsReportedAndFreed) {
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    driver_.missingPitch = 4;
    milliseconds took{};
    EXPECT_EQ(faultOfShow(took), card() + ", HDMI-A-1: no picture can be shown; dumb buffers: the "
                                          "display driver made a dumb buffer that is too small");
    EXPECT_EQ(driver_.buffers, 0);
}

TEST_F(KmsScreenTest, FollowsConnectionAndModeOfTheMonitor) {
    driver_.connected = false;
    ASSERT_EQ(screen_.look(true), Presence::Waiting);
    EXPECT_NE(screen_.status().find("no screen connected (HDMI-A-1 disconnected)"),
              std::string::npos)
        << screen_.status();
    driver_.connected = true;
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    show();
    driver_.width = 80;
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    EXPECT_EQ(screen_.size(), (Size{80, 48}));
    show();
    EXPECT_EQ(driver_.modeSets, 2);
    EXPECT_EQ(test::shownPixels().size(), 80U * 48U);
    driver_.connected = false;
    EXPECT_EQ(screen_.look(true), Presence::Waiting);
    EXPECT_EQ(driver_.buffers, 0);
}

// The screen shows a buffer of the lost context until the new context shows its first buffer.
TEST_F(KmsScreenTest, ThePictureStaysWhileTheContextIsRecreated) {
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    show();
    screen_.releaseGl();
    EXPECT_EQ(driver_.framebuffers, 2);
    EXPECT_FALSE(driver_.console);
    show();
    EXPECT_EQ(driver_.modeSets, 2);
    EXPECT_EQ(driver_.framebuffers, 2) << "there must be only the two new framebuffers";
    screen_.close();
    EXPECT_TRUE(driver_.console);
}

// The event of the last flip must not remain unread. Otherwise it would be mistaken for the event
// of the next flip.
TEST_F(KmsScreenTest, AFlipEndsBeforeTheContextIsRecreated) {
    ASSERT_EQ(screen_.look(true), Presence::Ready);
    show();
    show();
    screen_.releaseGl();
    EXPECT_EQ(driver_.flipped, 1);
    show();
    show();
    show();
    EXPECT_EQ(driver_.flipped, 2);
}

TEST_F(KmsScreenTest, DoesNotUseTheCrtcOfAnotherScreen) {
    driver_.secondScreen = true;
    const DrmCard card(this->card());
    const std::optional<DrmOutput> output = card.findOutput({}, true);
    ASSERT_TRUE(output);
    EXPECT_EQ(output->crtc, 11U);
    EXPECT_EQ(output->plane, 31U);
}

// At first the descriptor never becomes readable. Then its other end is closed.
TEST(WaitForFlip, EndsAtTheTimeLimitOrWhenTheDeviceIsGone) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    bool pending = true;
    const Timestamp begin = Timestamp::now();
    EXPECT_FALSE(waitForFlip(ends[0], pending, milliseconds(50)));
    EXPECT_GE(Timestamp::now() - begin, milliseconds(50));
    ::close(ends[1]);
    EXPECT_FALSE(waitForFlip(ends[0], pending, std::chrono::hours(1)));
    pending = false;
    EXPECT_TRUE(waitForFlip(ends[0], pending, milliseconds(0)));
    ::close(ends[0]);
}

}  // namespace
}  // namespace mfar
