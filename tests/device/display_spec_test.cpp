#include "hal/device/display_spec.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace mfar {
namespace {

using Kind = ScreenSpec::Kind;

TEST(ScreenSpec, ASpecWithOnlyATypeLeavesDeviceAndModeOpen) {
    EXPECT_EQ(parseScreenSpec("auto"), (ScreenSpec{Kind::Auto, "", "", {}}));
    EXPECT_EQ(parseScreenSpec("kms"), (ScreenSpec{Kind::Kms, "", "", {}}));
    EXPECT_EQ(parseScreenSpec("fbdev"), (ScreenSpec{Kind::Fbdev, "", "", {}}));
}

TEST(ScreenSpec, CardConnectorAndModeAreParsed) {
    EXPECT_EQ(parseScreenSpec("kms:card1,HDMI-A-2,1920x1080@59.94"),
              (ScreenSpec{Kind::Kms, "/dev/dri/card1", "HDMI-A-2", ModeWish{{1920, 1080}, 59.94}}));
    EXPECT_EQ(parseScreenSpec("kms,Virtual-1"), (ScreenSpec{Kind::Kms, "", "Virtual-1", {}}));
    EXPECT_EQ(parseScreenSpec("kms,1280x720"),
              (ScreenSpec{Kind::Kms, "", "", ModeWish{{1280, 720}, {}}}));
    EXPECT_EQ(parseScreenSpec("fbdev:/dev/fb12"), (ScreenSpec{Kind::Fbdev, "/dev/fb12", "", {}}));
}

TEST(ScreenSpec, UnknownWordsAreRefusedAndNamed) {
    for (const char* spec : {"",
                             "kmsx",
                             "auto:card0",
                             "auto,",
                             "kms:",
                             "kms,",
                             "kms:card",
                             "kms:cardx",
                             "kms:card0,",
                             "kms:card0,card1",
                             "kms,HDMI-A-1,HDMI-A-2",
                             "kms,HDMI-A-",
                             "kms,-1",
                             "kms,1280x720,1x1",
                             "kms,0x720",
                             "kms,-1x720",
                             "kms,1280x",
                             "kms,1280x720@",
                             "kms,1280x720@nan",
                             "kms,1280x720@0",
                             "kms,1280x720@1e9",
                             "kms,99999x720",
                             "kms,1280x720@60Hz",
                             "kms:../x",
                             "fbdev,",
                             "fbdev:",
                             "fbdev:fb0",
                             "fbdev:/dev/fb",
                             "fbdev:/dev/fb0x",
                             "fbdev:/dev/mem"})
        EXPECT_THROW((void)parseScreenSpec(spec), std::runtime_error) << spec;
    try {
        (void)parseScreenSpec("kms:card0,HDMI A,640x480");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("\"HDMI A\""), std::string::npos) << error.what();
    }
}

TEST(Letterbox, APictureFillsOneSideOfTheScreenAndIsCentredAlongTheOther) {
    EXPECT_EQ(letterbox({2304, 1728}, {1280, 720}), (ScreenRect{160, 0, {960, 720}}));
    EXPECT_EQ(letterbox({640, 480}, {480, 800}), (ScreenRect{0, 220, {480, 360}}));
    EXPECT_EQ(letterbox({1920, 1080}, {1920, 1080}), (ScreenRect{0, 0, {1920, 1080}}));
    EXPECT_EQ(letterbox({640, 480}, {1366, 768}), (ScreenRect{171, 0, {1024, 768}}));
}

TEST(Letterbox, APictureIsNeverBeyondTheScreenOrEmpty) {
    for (const Size picture : {Size{1, 16384}, {16384, 1}, {3, 7}, {2304, 1728}, {1, 1}})
        for (const Size screen : {Size{1, 1}, {16384, 2}, {7, 16384}, {1366, 768}, {1023, 1025}}) {
            const ScreenRect r = letterbox(picture, screen);
            EXPECT_GE(r.x, 0);
            EXPECT_GE(r.y, 0);
            EXPECT_GE(r.size.width, 1);
            EXPECT_GE(r.size.height, 1);
            EXPECT_LE(r.x + r.size.width, screen.width);
            EXPECT_LE(r.y + r.size.height, screen.height);
            EXPECT_TRUE(r.size.width == screen.width || r.size.height == screen.height);
        }
}

}  // namespace
}  // namespace mfar
