#include "hal/camera.h"
#include "hal/device/v4l2_controls.h"
#include "tests/device/error_of.h"
#include "tests/device/fake_v4l2.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <functional>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

using test::errorOf;
using test::FakeControl;
using test::FakeV4l2;

class V4l2ControlsTest : public testing::Test {
protected:
    V4l2ControlsTest() {
        fake_.controls = {
            {0x980900, "Brightness", V4L2_CTRL_TYPE_INTEGER, 0, 255, 5, 100},
            {0x980914, "Horizontal Flip", V4L2_CTRL_TYPE_BOOLEAN, 0, 1, 1, 0},
            {0x981901,
             "Trigger Mode",
             V4L2_CTRL_TYPE_MENU,
             0,
             3,
             1,
             0,
             {"Off", "", "External Edge", "Self"}},
            {0x981902, "single_trigger", V4L2_CTRL_TYPE_BUTTON, 0, 0, 0, 0},
            {0x981903,
             "Sensor Temperature",
             V4L2_CTRL_TYPE_INTEGER,
             -40,
             125,
             1,
             31,
             {},
             V4L2_CTRL_FLAG_READ_ONLY},
            {0x981904, "Exposure (us)", V4L2_CTRL_TYPE_INTEGER64, 1, 10'000'000'000, 1, 20'000},
            {0x9a0001, "Camera Controls", V4L2_CTRL_TYPE_CTRL_CLASS, 0, 0, 0, 0},
            {0x9a0903, "Held Gain", V4L2_CTRL_TYPE_INTEGER, 1, 8, 1, 2, {}, 0, 1000},
            {0x9a0904, "Gone", V4L2_CTRL_TYPE_INTEGER, 1, 8, 1, 2, {}, V4L2_CTRL_FLAG_DISABLED},
            {0x9a0905, "Region", V4L2_CTRL_TYPE_U32, 0, 8, 1, 2},
        };
    }
    FakeV4l2 fake_;
    V4l2Device device_{fake_, "/dev/video0"};
};

TEST(FoldedName, IsLowerCaseWithOneUnderscoreBetweenWords) {
    EXPECT_EQ(foldedName("Trigger Mode"), "trigger_mode");
    EXPECT_EQ(foldedName("trigger_mode"), "trigger_mode");
    EXPECT_EQ(foldedName("White Balance, Automatic"), "white_balance_automatic");
    EXPECT_EQ(foldedName("Exposure Time (Absolute)"), "exposure_time_absolute");
    EXPECT_EQ(foldedName("  "), "");
}

TEST_F(V4l2ControlsTest, ListHasAllControlsExceptTitlesAndDisabledOnes) {
    const V4l2Controls controls(device_);
    std::string all;
    for (const V4l2Control& c : controls.list())
        all += describe(c) + "\n";
    EXPECT_EQ(all, "brightness: 0 to 255 in steps of 5, default 100\n"
                   "horizontal_flip: on or off, default off\n"
                   "trigger_mode: 0 = Off, 2 = External Edge, 3 = Self, default 0\n"
                   "single_trigger: button\n"
                   "sensor_temperature: -40 to 125 in steps of 1, default 31, read-only\n"
                   "exposure_us: 1 to 10000000000 in steps of 1, default 20000\n"
                   "held_gain: 1 to 8 in steps of 1, default 2\n"
                   "region: has a type that cannot be set\n");
}

TEST_F(V4l2ControlsTest, ValuesAreSetAndReadBack) {
    const V4l2Controls controls(device_);
    EXPECT_EQ(controls.get("brightness"), 100);
    EXPECT_EQ(controls.set("BRIGHTNESS", 203), 200)
        << "set() must return the value that the driver chose";
    EXPECT_EQ(controls.get("Brightness"), 200);
    EXPECT_EQ(controls.set("exposure us", std::int64_t{5'000'000'000}), 5'000'000'000);
    EXPECT_EQ(controls.get("exposure_us"), 5'000'000'000);
    EXPECT_EQ(controls.get("sensor_temperature"), 31);
}

TEST_F(V4l2ControlsTest, ValuesMayBeNumbersWordsOrMenuEntries) {
    const V4l2Controls controls(device_);
    EXPECT_EQ(controls.set("brightness", "50"), 50);
    EXPECT_EQ(controls.set("horizontal_flip", "on"), 1);
    EXPECT_EQ(controls.set("horizontal_flip", "False"), 0);
    EXPECT_EQ(controls.set("horizontal_flip", "1"), 1);
    EXPECT_EQ(controls.set("trigger_mode", "external_edge"), 2);
    EXPECT_EQ(fake_.control("Trigger Mode"), 2);
    EXPECT_EQ(controls.set("trigger_mode", "3"), 3);
    EXPECT_EQ(controls.set("trigger_mode", "Off"), 0);
}

TEST_F(V4l2ControlsTest, ButtonsArePressed) {
    const V4l2Controls controls(device_);
    FakeControl& button = fake_.controls[3];
    ASSERT_EQ(button.name, "single_trigger");
    button.refusals = 1;
    controls.press("single trigger");
    EXPECT_EQ(button.refusals, 0) << "the driver must be asked to press the button";
    EXPECT_EQ(errorOf([&] { controls.press("brightness"); }),
              "/dev/video0: control brightness is not a button");
    EXPECT_EQ(errorOf([&] { static_cast<void>(controls.get("single_trigger")); }),
              "/dev/video0: control single_trigger cannot be read");
}

TEST_F(V4l2ControlsTest, EachRefusalStatesItsReason) {
    const V4l2Controls controls(device_);
    EXPECT_EQ(
        errorOf([&] { controls.set("contrast", 3); }),
        "/dev/video0: there is no control 'contrast'; available: brightness, horizontal_flip, "
        "trigger_mode, single_trigger, sensor_temperature, exposure_us, held_gain, region");
    EXPECT_EQ(errorOf([&] { controls.set("brightness", 256); }),
              "/dev/video0: control brightness cannot be 256; "
              "brightness: 0 to 255 in steps of 5, default 100");
    EXPECT_EQ(errorOf([&] { controls.set("brightness", "bright"); }),
              "/dev/video0: control brightness cannot be 'bright'; "
              "brightness: 0 to 255 in steps of 5, default 100");
    EXPECT_EQ(errorOf([&] { controls.set("trigger_mode", 1); }),
              "/dev/video0: control trigger_mode cannot be 1; "
              "trigger_mode: 0 = Off, 2 = External Edge, 3 = Self, default 0");
    EXPECT_EQ(errorOf([&] { controls.set("sensor_temperature", 20); }),
              "/dev/video0: control sensor_temperature is read-only");
    EXPECT_EQ(errorOf([&] { controls.set("held_gain", 3); }),
              "/dev/video0: control held_gain is busy and cannot be set now");
    EXPECT_EQ(errorOf([&] { controls.set("region", 1); }),
              "/dev/video0: control region has a type that cannot be set");
    EXPECT_EQ(fake_.control("Brightness"), 100);
}

TEST_F(V4l2ControlsTest, BusyControlsAreTriedThreeTimes) {
    FakeControl& gain = fake_.controls[7];
    ASSERT_EQ(gain.name, "Held Gain");
    const V4l2Controls controls(device_);
    for (const int error : {EBUSY, EIO, ETIMEDOUT, EPROTO, EPIPE}) {
        gain.error = error;
        gain.refusals = 2;
        EXPECT_EQ(controls.set("held_gain", 3), 3) << error;
        gain.refusals = 3;
        EXPECT_NE(errorOf([&] { controls.set("held_gain", 4); }), "no error") << error;
        EXPECT_EQ(gain.refusals, 0) << error;
        EXPECT_EQ(gain.value, 3) << error;
    }
    gain.error = EINVAL;
    gain.refusals = 3;
    EXPECT_NE(errorOf([&] { controls.set("held_gain", 4); }), "no error");
    EXPECT_EQ(gain.refusals, 2) << "a permanent refusal must not be tried again";
}

TEST_F(V4l2ControlsTest, LostDeviceIsReported) {
    const V4l2Controls controls(device_);
    fake_.unplug();
    EXPECT_THROW(controls.set("brightness", 5), DeviceLost);
    EXPECT_THROW(static_cast<void>(controls.get("brightness")), DeviceLost);
    EXPECT_THROW(V4l2Controls{device_}, DeviceLost);
}

}  // namespace
}  // namespace mfar
