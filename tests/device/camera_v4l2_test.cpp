#include "hal/device/camera_v4l2.h"
#include "tests/device/error_of.h"
#include "tests/device/fake_v4l2.h"

#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

using namespace std::chrono_literals;
using test::errorOf;
using test::FakePicture;
using test::FakeV4l2;

constexpr Size kSize{32, 24};

CameraV4l2Options wanted(const std::string& format = {}, double rateHz = 0) {
    CameraV4l2Options out;
    out.device.name = "/dev/video0";
    out.wish = {kSize, rateHz, format};
    out.buffers = 4;
    return out;
}

TEST(CameraV4l2, PicturesOfTheDriverAreLentToTheUser) {
    FakeV4l2 fake;
    fake.padding = 12;
    fake.quantization = V4L2_QUANTIZATION_FULL_RANGE;
    CameraV4l2 camera(wanted({}, 25), fake);
    EXPECT_EQ(camera.info().name, "Fake Camera (/dev/video0)");
    EXPECT_EQ(camera.info().size, kSize);
    EXPECT_EQ(camera.info().format, PixelFormat::Yuyv);
    EXPECT_EQ(camera.info().rateHz, 25);
    camera.start();
    const Timestamp before = Timestamp::now();
    ASSERT_TRUE(fake.deliver({.ageMs = 20, .level = 77}));
    const Timestamp delivered = Timestamp::now();
    const auto frame = camera.next(1s);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->view().size, kSize);
    EXPECT_EQ(frame->view().stride, 32U * 2 + 12);
    EXPECT_EQ(frame->view().range, YuvRange::Full);
    EXPECT_EQ(frame->view().data[frame->view().stride * 23 + 63], 77);
    EXPECT_GE(frame->time(), before - 20ms - 1us);
    EXPECT_LE(frame->time(), delivered - 20ms);
    EXPECT_EQ(camera.cameraCounters().delivered, 1U);
}

TEST(CameraV4l2, FormatsAreChosenInTheOrderOfPreference) {
    FakeV4l2 fake;
    const auto chosen = [&](const std::string& format = {}, double rateHz = 0) {
        return CameraV4l2(wanted(format, rateHz), fake).info().format;
    };
    fake.formats = {{V4L2_PIX_FMT_GREY, {kSize}}};
    EXPECT_EQ(chosen(), PixelFormat::Gray8);
    fake.formats.push_back({V4L2_PIX_FMT_XBGR32, {kSize}});
    EXPECT_EQ(chosen(), PixelFormat::Bgra8);
    fake.formats.push_back({V4L2_PIX_FMT_YUYV, {{64, 48}, kSize}, 5});
    EXPECT_EQ(chosen(), PixelFormat::Yuyv);
    EXPECT_EQ(chosen({}, 30), PixelFormat::Bgra8)
        << "only the BGRA format is fast enough and has colours";
    EXPECT_EQ(chosen({}, 60), PixelFormat::Yuyv)
        << "no format is fast enough, so the preferred one is used";
    fake.formats.push_back({V4L2_PIX_FMT_YUV420, {kSize}});
    EXPECT_EQ(chosen(), PixelFormat::Yuv420);
    fake.formats.push_back({V4L2_PIX_FMT_NV12, {{64, 48}}});
    EXPECT_EQ(chosen(), PixelFormat::Yuv420) << "NV12 is not offered in the wanted size";
    EXPECT_EQ(chosen("GREY"), PixelFormat::Gray8);
}

TEST(CameraV4l2, ARefusedSizeIsReportedWithTheOfferedSizes) {
    FakeV4l2 fake;
    fake.formats = {{V4L2_PIX_FMT_YUYV, {{64, 48}, {160, 120}}}, {V4L2_PIX_FMT_SBGGR8, {kSize}}};
    EXPECT_EQ(errorOf([&] { CameraV4l2(wanted(), fake); }),
              "/dev/video0: camera 'Fake Camera' does not offer 32x24 in a format that can be "
              "used; it offers\n"
              "  YUYV: 64x48 160x120\n"
              "  BA81: 32x24");
    EXPECT_EQ(errorOf([&] { CameraV4l2(wanted("NV12"), fake); }).substr(0, 65),
              "/dev/video0: camera 'Fake Camera' does not offer 32x24 in NV12; i");
}

TEST(CameraV4l2, ADriverThatChangesThePictureSizeIsRefused) {
    FakeV4l2 fake;
    fake.formats = {{V4L2_PIX_FMT_YUYV, {}}};
    fake.rounds = true;
    EXPECT_EQ(errorOf([&] { CameraV4l2(wanted(), fake); }),
              "/dev/video0: camera 'Fake Camera' offers 16x16 YUYV instead of 32x24 YUYV");
}

TEST(CameraV4l2, InvalidDriverDataIsRefused) {
    const auto errorWith = [](const std::function<void(FakeV4l2&)>& change) {
        FakeV4l2 fake;
        change(fake);
        return errorOf([&] { CameraV4l2(wanted(), fake); });
    };
    EXPECT_EQ(errorWith([](FakeV4l2& f) { f.sizeFault = -1; }),
              "/dev/video0: the driver reports an invalid format: a picture has 1535 bytes, but "
              "its rows need 1536");
    EXPECT_EQ(errorWith([](FakeV4l2& f) { f.padding = std::size_t{2} << 20; }),
              "/dev/video0: the driver reports an invalid format: a row has 2097216 bytes");
    EXPECT_EQ(errorWith([](FakeV4l2& f) { f.clock = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN; }),
              "/dev/video0: the driver's timestamps do not use CLOCK_MONOTONIC");
}

TEST(CameraV4l2, ABusyDeviceIsReported) {
    FakeV4l2 fake;
    fake.busy = true;
    EXPECT_EQ(errorOf([&] { CameraV4l2(wanted(), fake); }),
              "/dev/video0: setting the format: busy: another program uses it");
}

TEST(CameraV4l2, DeviceIsFoundByCardAndBus) {
    FakeV4l2 fake;
    CameraV4l2Options options = wanted();
    for (const char* name : {"Fake Camera", "fake:1"}) {
        options.device.name = name;
        EXPECT_EQ(CameraV4l2(options, fake).info().name, "Fake Camera (/dev/video0)");
    }
    options.device.name = "Other";
    EXPECT_EQ(errorOf([&] { CameraV4l2(options, fake); }),
              "camera 'Other' was not found; available:\n  /dev/video0: 'Fake Camera' at fake:1");
    fake.secondPath = "/dev/video2";
    options.device.name = "Fake Camera";
    EXPECT_EQ(errorOf([&] { CameraV4l2(options, fake); }).substr(0, 67),
              "several cameras match 'Fake Camera'; choose one by its path or bus:");
    options.device.name = "/dev/video1";
    EXPECT_EQ(errorOf([&] { CameraV4l2(options, fake); }),
              "/dev/video1: 'Fake Camera' is not a capture device");
    options.device.name = "/dev/video9";
    EXPECT_EQ(errorOf([&] { CameraV4l2(options, fake); }),
              "/dev/video9: No such file or directory");
}

TEST(CameraV4l2, WithoutANameTheExcludedCameraIsNotChosen) {
    FakeV4l2 fake;
    CameraV4l2Options options = wanted();
    options.device = {};
    EXPECT_EQ(CameraV4l2(options, fake).info().name, "Fake Camera (/dev/video0)");
    options.device.largest = true;
    EXPECT_EQ(errorOf([&] { CameraV4l2(options, fake); }),
              "no second camera was found; available:\n  /dev/video0: 'Fake Camera' at fake:1");
    // If two cameras have equal picture sizes, the one whose path comes last counts as larger.
    fake.secondPath = "/dev/video2";
    EXPECT_EQ(CameraV4l2(options, fake).info().name, "Fake Camera (/dev/video2)");
    options.device.except = "/dev/video2";
    EXPECT_EQ(CameraV4l2(options, fake).info().name, "Fake Camera (/dev/video0)");
    options.device = {.except = "/dev/video0"};
    EXPECT_EQ(CameraV4l2(options, fake).info().name, "Fake Camera (/dev/video2)");
}

TEST(CameraV4l2, WithoutAnyCameraTheErrorListsWhyDevicesCannotBeOpened) {
    FakeV4l2 fake;
    fake.unplug();
    CameraV4l2Options options = wanted();
    options.device = {};
    EXPECT_EQ(errorOf([&] { CameraV4l2(options, fake); }),
              "no camera was found; available:\n  /dev/video0: No such file or directory\n"
              "  /dev/video1: No such file or directory");
}

TEST(CameraV4l2, ControlsAreSetBeforeStreamingStarts) {
    FakeV4l2 fake;
    fake.controls = {{0x980900, "Brightness", V4L2_CTRL_TYPE_INTEGER, 0, 255, 1, 100}};
    CameraV4l2Options options = wanted();
    options.controls = {{"brightness", "12"}};
    const CameraV4l2 camera(options, fake);
    EXPECT_EQ(fake.control("Brightness"), 12);
    EXPECT_EQ(camera.controls().get("brightness"), 12);
}

TEST(CameraV4l2, BrokenPicturesAreCountedAndNeverDelivered) {
    FakeV4l2 fake;
    CameraV4l2 camera(wanted(), fake);
    camera.start();
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(fake.deliver({.flags = V4L2_BUF_FLAG_ERROR, .level = 1}));
        ASSERT_TRUE(fake.deliver({.missingBytes = 1, .level = 2}));
        EXPECT_FALSE(camera.next(0ms).has_value());
    }
    EXPECT_EQ(camera.cameraCounters().broken, 20U);
    EXPECT_EQ(fake.queued(), 4) << "the buffers of broken pictures must be queued again";
    ASSERT_TRUE(fake.deliver({.level = 3}));
    EXPECT_EQ(camera.next(1s)->view().data[0], 3);
    EXPECT_EQ(camera.cameraCounters().delivered, 1U);
}

TEST(CameraV4l2, PicturesWithImpossibleTimesAreCountedAndNeverDelivered) {
    FakeV4l2 fake;
    CameraV4l2 camera(wanted(), fake);
    camera.start();
    fake.deliver({.ageMs = -1000});
    fake.deliver({.ageMs = 60'000});
    EXPECT_FALSE(camera.next(0ms).has_value());
    fake.deliver({.ageMs = 10});
    EXPECT_TRUE(camera.next(1s).has_value());
    fake.deliver({.ageMs = 500});
    EXPECT_FALSE(camera.next(0ms).has_value())
        << "a picture older than the previous one must be refused";
    EXPECT_EQ(camera.cameraCounters().badTimes, 3U);
}

TEST(CameraV4l2, MissedPicturesAreCounted) {
    FakeV4l2 fake;
    CameraV4l2 camera(wanted(), fake);
    camera.start();
    fake.deliver({.ageMs = 30});
    fake.deliver({.ageMs = 20, .skipped = 3});
    static_cast<void>(camera.next(1s));
    static_cast<void>(camera.next(1s));
    EXPECT_EQ(camera.cameraCounters().missed, 3U);
}

TEST(CameraV4l2, TheTimeOfAPictureIsTheMiddleOfItsManualExposure) {
    // Returns true if the picture's time is its time stamp plus `shift`.
    const auto isShifted = [](std::uint32_t flags, std::int64_t mode,
                              std::chrono::milliseconds shift) {
        FakeV4l2 fake;
        fake.controls = {
            {0x9a0901, "Auto Exposure", V4L2_CTRL_TYPE_INTEGER, 0, 3, 1, mode},
            {0x9a0902, "Exposure Time, Absolute", V4L2_CTRL_TYPE_INTEGER, 1, 5000, 1, 2000}};
        CameraV4l2 camera(wanted(), fake);
        camera.start();
        const Timestamp before = Timestamp::now();
        fake.deliver({.flags = flags, .ageMs = 1000});
        const Timestamp after = Timestamp::now();
        const auto frame = camera.next(1s);
        EXPECT_EQ(frame->exposure, shift == 0ms ? 0ms : 200ms);
        const Timestamp stamp = frame->time() - shift + 1s;
        return stamp >= before - 1us && stamp <= after;  // the stamp has whole microseconds
    };
    EXPECT_TRUE(isShifted(V4L2_BUF_FLAG_TSTAMP_SRC_SOE, V4L2_EXPOSURE_MANUAL, 100ms));
    EXPECT_TRUE(isShifted(V4L2_BUF_FLAG_TSTAMP_SRC_EOF, V4L2_EXPOSURE_MANUAL, -100ms));
    EXPECT_TRUE(isShifted(V4L2_BUF_FLAG_TSTAMP_SRC_SOE, V4L2_EXPOSURE_SHUTTER_PRIORITY, 100ms));
    EXPECT_TRUE(isShifted(V4L2_BUF_FLAG_TSTAMP_SRC_SOE, V4L2_EXPOSURE_APERTURE_PRIORITY, 0ms));
    EXPECT_TRUE(isShifted(V4L2_BUF_FLAG_TSTAMP_SRC_SOE, V4L2_EXPOSURE_AUTO, 0ms));
}

TEST(CameraV4l2, AnExposureThatCannotBeReadCountsAsUnknown) {
    FakeV4l2 fake;
    fake.controls = {
        {0x9a0902, "Exposure Time, Absolute", V4L2_CTRL_TYPE_INTEGER, 1, 5000, 1, 2000}};
    fake.controls[0].isUnreadable = true;
    CameraV4l2 camera(wanted(), fake);
    camera.start();
    fake.deliver({});
    const auto frame = camera.next(1s);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->exposure, 0ms);
}

TEST(CameraV4l2, WithoutANameOnlyDevicesThatCanBeCamerasAreChosen) {
    FakeV4l2 fake;
    CameraV4l2Options any = wanted();
    any.device.name.clear();
    EXPECT_NO_THROW(CameraV4l2(any, fake));
    fake.hasInput = false;
    EXPECT_NE(errorOf([&] { CameraV4l2(any, fake); }).find("no camera was found"),
              std::string::npos);
    EXPECT_NO_THROW(CameraV4l2(wanted(), fake)) << "a configured device must be accepted";
    fake.hasInput = true;
    fake.formats = {{V4L2_PIX_FMT_SBGGR8, {kSize}}};
    EXPECT_NE(errorOf([&] { CameraV4l2(any, fake); }).find("no camera was found"),
              std::string::npos);
}

TEST(CameraV4l2, StopWakesAThreadThatWaitsForAPicture) {
    FakeV4l2 fake;
    CameraV4l2 camera(wanted(), fake);
    camera.start();
    auto waiting = std::async(std::launch::async, [&] { return camera.next(60s).has_value(); });
    EXPECT_EQ(waiting.wait_for(20ms), std::future_status::timeout);
    camera.stop();
    ASSERT_EQ(waiting.wait_for(20s), std::future_status::ready);
    EXPECT_FALSE(waiting.get());
    EXPECT_FALSE(camera.next(60s).has_value());
    camera.stop();
}

TEST(CameraV4l2, ACameraCanBeStartedAgainAfterStop) {
    FakeV4l2 fake;
    CameraV4l2 camera(wanted(), fake);
    camera.start();
    fake.deliver({.ageMs = 30});
    auto held = camera.next(1s);
    ASSERT_TRUE(held.has_value());
    fake.deliver({.ageMs = 20, .level = 5});  // stays in the queue until stop()
    camera.stop();
    camera.start();
    EXPECT_EQ(fake.queued(), 3) << "all buffers must be queued except the one that is held";
    fake.deliver({.ageMs = 10, .level = 9});
    EXPECT_EQ(camera.next(1s)->view().data[0], 9);
    held.reset();
    EXPECT_FALSE(camera.next(0ms).has_value());
    EXPECT_EQ(fake.queued(), 4);
}

TEST(CameraV4l2, RestartedFrameNumbersAreNotCountedAsMissed) {
    FakeV4l2 fake;
    CameraV4l2 camera(wanted({}, 30), fake);
    camera.start();
    fake.deliver({.ageMs = 40, .skipped = 200});
    fake.deliver({.flags = V4L2_BUF_FLAG_ERROR, .ageMs = 30});
    fake.deliver({.ageMs = 20, .skipped = -201});
    fake.deliver({.ageMs = 10});
    for (int i = 0; i < 3; ++i)
        ASSERT_TRUE(camera.next(1s).has_value());
    EXPECT_EQ(camera.cameraCounters().missed, 0U);
    EXPECT_EQ(camera.cameraCounters().broken, 1U);
}

TEST(CameraV4l2, AnUnpluggedDeviceIsReportedAsLost) {
    FakeV4l2 fake;
    CameraV4l2 camera(wanted(), fake);
    camera.start();
    fake.deliver({.level = 42});
    const auto held = camera.next(1s);
    auto waiting = std::async(std::launch::async, [&] { static_cast<void>(camera.next(60s)); });
    EXPECT_EQ(waiting.wait_for(20ms), std::future_status::timeout);
    fake.unplug();
    ASSERT_EQ(waiting.wait_for(20s), std::future_status::ready);
    EXPECT_THROW(waiting.get(), DeviceLost);
    EXPECT_THROW(static_cast<void>(camera.next(1s)), DeviceLost);
    EXPECT_EQ(held->view().data[0], 42);
    camera.stop();
    EXPECT_THROW(camera.start(), DeviceLost);
}

// With the kernel's videobuf2, poll() reports an error after the start of streaming until a buffer
// is queued.
TEST(CameraV4l2, APollErrorAloneDoesNotMeanDeviceLost) {
    FakeV4l2 fake;
    CameraV4l2 camera(wanted(), fake);
    camera.start();
    fake.hangUp();
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_FALSE(camera.next(20ms).has_value());
    EXPECT_GE(std::chrono::steady_clock::now() - begin, 20ms);
    fake.unplug();
    EXPECT_THROW(static_cast<void>(camera.next(1s)), DeviceLost);
}

}  // namespace
}  // namespace mfar
