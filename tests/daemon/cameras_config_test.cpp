#include "daemon/config.h"
#include "tests/daemon/config_faults.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using test::configFaults;
using testing::AllOf;
using testing::HasSubstr;
using testing::Pair;

TEST(CamerasConfig, EveryKeyIsRead) {
    const CamerasConfig cameras = parseConfig(R"(
source = "cameras"
[cameras]
calibration = "lenses"
[cameras.video]
driver = "v4l2"
camera = "/dev/video3"
width = 320
height = 240
rate_hz = 60
format = "YUYV"
controls = { mode = "manual", "Gain" = 2.5, flip = true, exposure_auto = 1 }
[cameras.still]
allow_crop = true
width = 1280
height = 960
[cameras.trigger]
chip = "pl061"
line = "5"
active_low = true
pulse_ms = 0.5
pulse_is_exposure = true
loopback_chip = "gpiochip1"
loopback = "6"
delay_ms = 2
jitter_ms = 3
arrival_ms = 700
)",
                                              "/etc/mfar/test.toml")
                                      .cameras;
    EXPECT_EQ(cameras.calibration, "/etc/mfar/lenses");
    EXPECT_EQ(cameras.video.driver, CameraDriver::V4l2);
    EXPECT_EQ(cameras.video.camera, "/dev/video3");
    EXPECT_EQ(cameras.video.size, (Size{320, 240}));
    EXPECT_EQ(cameras.video.rateHz, 60);
    EXPECT_EQ(cameras.video.format, "YUYV");
    EXPECT_THAT(cameras.video.controls,
                testing::ElementsAre(Pair("mode", "manual"), Pair("Gain", "2.5"),
                                     Pair("flip", "true"), Pair("exposure_auto", "1")));
    EXPECT_FALSE(cameras.video.allowCrop);
    EXPECT_TRUE(cameras.still.allowCrop);
    EXPECT_EQ(cameras.still.driver, CameraDriver::Libcamera);
    EXPECT_EQ(cameras.still.size, (Size{1280, 960}));
    EXPECT_EQ(cameras.still.rateHz, 0);
    EXPECT_EQ(cameras.trigger,
              (TriggerLineConfig{"pl061", "5", true, 0.5, true, "gpiochip1", "6", 2, 3, 700}));
}

TEST(CamerasConfig, FaultsAreReportedWithLineAndColumn) {
    EXPECT_THAT(
        configFaults("[cameras.video]\nwidth = 0\ndriver = \"usb\"\ncontrols = { gain = [1] }\n"
                     "colour = 3\n[cameras.trigger]\npulse_ms = nan\nline = 5\n"),
        AllOf(HasSubstr("test.toml:2:9: cameras.video.width must be from 16 to 8192, not 0"),
              HasSubstr(":3:10: cameras.video.driver = \"usb\": must be one of"),
              HasSubstr(":4:21: cameras.video.controls.gain must be a number"),
              HasSubstr(":5:1: unknown key cameras.video.colour"),
              HasSubstr(":7:12: cameras.trigger.pulse_ms must be from 0.001 to 10000"),
              HasSubstr(":8:8: cameras.trigger.line must be a text in quotes")));
}

TEST(CamerasConfig, TheNumberOfALineNeedsItsChip) {
    const std::string trigger = "[cameras.trigger]\n";
    EXPECT_THAT(configFaults(trigger + "line = \"17\"\nloopback = \"4\"\n"),
                AllOf(HasSubstr("test.toml:2:8: cameras.trigger.line"),
                      HasSubstr(":3:12: cameras.trigger.loopback"),
                      HasSubstr("is a line's number, so its chip must be set, too")));
    EXPECT_EQ(configFaults(trigger + "line = \"17\"\nchip = \"gpiochip0\"\n"), "");
    EXPECT_EQ(configFaults(trigger + "line = \"GPIO17\"\n"), "");
}

TEST(CamerasConfig, TheChipOfTheTriggerLineIsAlsoThatOfTheLoopback) {
    EXPECT_EQ(configFaults("[cameras.trigger]\nchip = \"gpiochip0\"\nline = \"17\"\n"
                           "loopback = \"27\"\n"),
              "");
}

TEST(CamerasConfig, APulseLongerThanTheTimeoutOfStillsIsRefused) {
    const std::string pulse = "[cameras.trigger]\npulse_ms = 5000\nline = \"GPIO17\"\n";
    EXPECT_EQ(configFaults(pulse),
              "test.toml:2:12: cameras.trigger.pulse_ms = 5000: must be shorter than "
              "trigger.timeout_s, which is 3 s");
    EXPECT_EQ(configFaults(pulse + "[trigger]\ntimeout_s = 6\n"), "");
}

TEST(CamerasConfig, OnlyTheRateOfTheStillCameraMayBeZero) {
    EXPECT_THAT(configFaults("[cameras.video]\nrate_hz = 0\n"),
                HasSubstr("test.toml:2:11: cameras.video.rate_hz must be from 0.01 to 1000"));
    EXPECT_EQ(configFaults("[cameras.still]\nrate_hz = 0\n"), "");
    EXPECT_THAT(configFaults("[cameras.still]\nrate_hz = 0.001\n"),
                HasSubstr("must be 0 or at least 0.01 Hz"));
}

TEST(CamerasConfig, OneCameraForBothSensorsIsRefused) {
    const std::string video = "[cameras.video]\ncamera = \"a\"\n[cameras.still]\n";
    EXPECT_EQ(configFaults(video + "camera = \"a\"\n"),
              "test.toml:4:10: cameras.still.camera = \"a\": is already the camera of "
              "[cameras.video]");
    EXPECT_EQ(configFaults(video + "camera = \"b\"\n"), "");
    EXPECT_EQ(configFaults(video + "driver = \"v4l2\"\ncamera = \"a\"\n"), "");
    EXPECT_EQ(configFaults("[cameras.video]\ncamera = \"\"\n[cameras.still]\ncamera = \"\"\n"), "");
}

TEST(CamerasConfig, AFormatForALibcameraCameraIsRefused) {
    EXPECT_EQ(configFaults("[cameras.still]\nformat = \"auto\"\n"), "");
    EXPECT_THAT(configFaults("[cameras.still]\nformat = \"NV12\"\n"), HasSubstr("libcamera"));
    EXPECT_EQ(configFaults("[cameras.still]\ndriver = \"v4l2\"\nformat = \"NV12\"\n"), "");
}

TEST(CamerasConfig, ChangedCameraSettingsNeedARestart) {
    const Config running = parseConfig("source = \"cameras\"", "a.toml");
    const Config wanted =
        parseConfig("source = \"cameras\"\n[cameras.still]\nwidth = 1280\nheight = 960", "a.toml");
    EXPECT_EQ(needRestart(running, wanted), "cameras");
}

}  // namespace
}  // namespace mfar
