#include "hal/device/camera_v4l2.h"
#include "tests/device/fake_v4l2.h"
#include "tests/device/jpeg_of.h"

#include <gtest/gtest.h>

#include <system_error>

#include <cstdint>
#include <filesystem>
#include <future>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace mfar {
namespace {

using namespace std::chrono_literals;
using test::FakeV4l2;

constexpr Size kPicture{32, 24};

CameraV4l2Options fourBuffers() {
    CameraV4l2Options out;
    out.device.name = "/dev/video0";
    out.wish.size = kPicture;
    out.buffers = 4;
    return out;
}

TEST(CameraV4l2Buffers, AllBuffersCanBeLentAtTheSameTime) {
    FakeV4l2 fake;
    CameraV4l2 camera(fourBuffers(), fake);
    camera.start();
    std::vector<Frame> held;
    for (int i = 0; i < 4; ++i) {
        ASSERT_TRUE(fake.deliver({.ageMs = 50 - i, .level = static_cast<std::uint8_t>(i)}));
        auto frame = camera.next(1s);
        ASSERT_TRUE(frame.has_value());
        held.push_back(std::move(*frame));
    }
    EXPECT_FALSE(fake.deliver()) << "all buffers are lent, so no picture can be delivered";
    EXPECT_FALSE(camera.next(5ms).has_value());
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(held[static_cast<std::size_t>(i)].view().data[100], i);
    held.pop_back();
    EXPECT_FALSE(camera.next(0ms).has_value());
    EXPECT_TRUE(fake.deliver());
    EXPECT_TRUE(camera.next(1s).has_value());
    EXPECT_EQ(camera.cameraCounters().missed, 1U);
}

TEST(CameraV4l2Buffers, ReturnedBuffersAreQueuedWhileAThreadWaitsForAPicture) {
    FakeV4l2 fake;
    CameraV4l2 camera(fourBuffers(), fake);
    camera.start();
    fake.deliver({.ageMs = 30});
    auto held = camera.next(1s);
    ASSERT_TRUE(held.has_value());
    EXPECT_EQ(fake.queued(), 3);
    auto waiting = std::async(std::launch::async, [&] { return camera.next(60s).has_value(); });
    EXPECT_EQ(waiting.wait_for(20ms), std::future_status::timeout);
    held.reset();
    for (const auto end = std::chrono::steady_clock::now() + 20s;
         fake.queued() < 4 && std::chrono::steady_clock::now() < end;)
        std::this_thread::sleep_for(1ms);
    EXPECT_EQ(fake.queued(), 4);
    fake.deliver();
    EXPECT_TRUE(waiting.get());
}

TEST(CameraV4l2Buffers, GivingAPictureBackDoesNotWaitForADriverThatHangs) {
    FakeV4l2 fake;
    CameraV4l2 camera(fourBuffers(), fake);
    camera.start();
    fake.deliver({.ageMs = 30});
    auto held = camera.next(1s);
    ASSERT_TRUE(held.has_value());
    fake.hang(true);
    fake.deliver({.ageMs = 20});
    auto hung = std::async(std::launch::async, [&] { return camera.next(60s).has_value(); });
    while (!fake.hangs())
        std::this_thread::sleep_for(1ms);
    auto given = std::async(std::launch::async, [&] { held.reset(); });
    EXPECT_EQ(given.wait_for(20s), std::future_status::ready);
    fake.hang(false);
    EXPECT_TRUE(hung.get());
}

TEST(CameraV4l2Buffers, FewBuffersSufficeForManyPictures) {
    for (const bool refuses : {false, true})
        for (const std::uint32_t buffers : {1U, 2U, 3U}) {
            FakeV4l2 fake;
            fake.mostBuffers = buffers;
            fake.refusesMore = refuses;
            CameraV4l2Options options = fourBuffers();
            options.buffers = 6;
            CameraV4l2 camera(options, fake);
            EXPECT_EQ(camera.takeWarnings(),
                      std::vector<std::string>{"/dev/video0: the driver allocated only " +
                                               std::to_string(buffers) +
                                               " of 6 buffers, so every picture is copied"});
            EXPECT_TRUE(camera.takeWarnings().empty()) << "the warning must come only once";
            camera.start();
            std::vector<Frame> held;
            for (std::uint8_t i = 0; i < 6; ++i) {
                ASSERT_TRUE(fake.deliver({.ageMs = 50 - i, .level = i})) << buffers;
                auto frame = camera.next(1s);
                ASSERT_TRUE(frame.has_value());
                held.push_back(std::move(*frame));
                EXPECT_FALSE(camera.next(0ms).has_value());
            }
            for (std::size_t i = 0; i < held.size(); ++i) {
                EXPECT_EQ(held[i].view().size, kPicture);
                EXPECT_EQ(held[i].view().data[100], i);
            }
            // The user holds as many pictures as options.buffers allows. So the next picture is
            // lost and counted.
            ASSERT_TRUE(fake.deliver());
            EXPECT_FALSE(camera.next(0ms).has_value());
            EXPECT_EQ(camera.cameraCounters().missed, 1U);
            EXPECT_EQ(camera.cameraCounters().delivered, 6U);
        }
}

TEST(CameraV4l2Buffers, WithEnoughBuffersPicturesAreLentWithoutACopy) {
    FakeV4l2 fake;
    fake.mostBuffers = 4;
    CameraV4l2Options options = fourBuffers();
    options.buffers = 6;
    CameraV4l2 camera(options, fake);
    EXPECT_TRUE(camera.takeWarnings().empty());
    camera.start();
    fake.deliver();
    const auto held = camera.next(1s);
    EXPECT_FALSE(camera.next(0ms).has_value());
    EXPECT_EQ(fake.queued(), 3);
}

int eventDescriptors() {
    int out = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code error;  // ignored: the iterator's own descriptor can be closed by now
        out += std::filesystem::read_symlink(entry.path(), error) == "anon_inode:[eventfd]" ? 1 : 0;
    }
    return out;
}

TEST(CameraV4l2Buffers, AFrameOfAClosedCameraKeepsOnlyItsMemory) {
    const int before = eventDescriptors();
    FakeV4l2 fake;
    std::optional<Frame> held;
    {
        CameraV4l2 camera(fourBuffers(), fake);
        camera.start();
        fake.deliver();
        held = camera.next(1s);
        EXPECT_GT(eventDescriptors(), before);
    }
    ASSERT_TRUE(held.has_value());
    EXPECT_EQ(eventDescriptors(), before);
}

TEST(CameraV4l2Buffers, FramesOutliveTheCameraAndDoNotBlockTheNextCamera) {
    FakeV4l2 fake;
    std::optional<Frame> held;
    {
        CameraV4l2 camera(fourBuffers(), fake);
        camera.start();
        fake.deliver({.level = 42});
        held = camera.next(1s);
    }
    ASSERT_TRUE(held.has_value());
    EXPECT_TRUE(fake.released());
    EXPECT_EQ(held->view().data[64 * 24 - 1], 42);
    CameraV4l2 next(fourBuffers(), fake);
    next.start();
    EXPECT_EQ(fake.queued(), 4);
    held.reset();
    EXPECT_EQ(fake.queued(), 4);
}

TEST(CameraV4l2Buffers, PlanesAreFoundInBothBufferTypes) {
    for (const auto& [fourcc, multi, format] :
         {std::tuple{V4L2_PIX_FMT_NV12, false, PixelFormat::Nv12},
          std::tuple{V4L2_PIX_FMT_YUV420, false, PixelFormat::Yuv420},
          std::tuple{V4L2_PIX_FMT_NV12, true, PixelFormat::Nv12},
          std::tuple{V4L2_PIX_FMT_NV12M, true, PixelFormat::Nv12}}) {
        FakeV4l2 fake;
        fake.multiPlanar = multi;
        fake.padding = 8;
        fake.colorspace = V4L2_COLORSPACE_REC709;
        fake.formats = {{fourcc, {kPicture}}};
        CameraV4l2 camera(fourBuffers(), fake);
        camera.start();
        fake.deliver({.level = 61});
        const auto frame = camera.next(1s);
        ASSERT_TRUE(frame.has_value());
        const ImageView& view = frame->view();
        EXPECT_EQ(view.format, format);
        EXPECT_EQ(view.stride, 40U);
        EXPECT_EQ(view.matrix, YuvMatrix::Bt709);
        EXPECT_EQ(view.range, YuvRange::Limited);
        const bool threePlanes = format == PixelFormat::Yuv420;
        EXPECT_EQ(view.chroma[0].stride, threePlanes ? 20U : 40U);
        if (fourcc != V4L2_PIX_FMT_NV12M) {
            EXPECT_EQ(view.chroma[0].data - view.data, 40 * 24);
        }
        if (threePlanes) {
            EXPECT_EQ(view.chroma[1].data - view.chroma[0].data, 20 * 12);
        }
        EXPECT_EQ(view.chroma[0].data[view.chroma[0].stride * 12 - 1], 61);
    }
}

TEST(CameraV4l2Buffers, PlanesMayBeginAfterTheStartOfTheirMemory) {
    FakeV4l2 fake;
    fake.multiPlanar = true;
    fake.dataOffset = 64;
    fake.formats = {{V4L2_PIX_FMT_NV12M, {kPicture}}};
    CameraV4l2 camera(fourBuffers(), fake);
    camera.start();
    fake.deliver({.level = 61});
    const auto frame = camera.next(1s);
    ASSERT_TRUE(frame.has_value());
    const ImageView& view = frame->view();
    for (const std::uint8_t byte :
         {view.data[0], view.data[view.stride * 23 + 31], view.chroma[0].data[0],
          view.chroma[0].data[view.chroma[0].stride * 11 + 31]})
        EXPECT_EQ(byte, 61);
    fake.deliver({.missingBytes = 1});
    EXPECT_FALSE(camera.next(0ms).has_value()) << "a plane lacks its last byte";
    EXPECT_EQ(camera.cameraCounters().broken, 1U);
}

std::vector<std::uint8_t> whiteJpeg() {
    const std::vector<std::uint8_t> white(3UL * kPicture.width * kPicture.height, 255);
    return test::jpegOf(white, kPicture, TJSAMP_422);
}

TEST(CameraV4l2Buffers, JpegsAreDecoded) {
    FakeV4l2 fake;
    fake.formats = {{V4L2_PIX_FMT_MJPEG, {kPicture}}};
    CameraV4l2 camera(fourBuffers(), fake);
    camera.start();
    const std::vector<std::uint8_t> jpeg = whiteJpeg();
    const Timestamp before = Timestamp::now();
    fake.deliver({.jpeg = jpeg});
    const auto frame = camera.next(1s);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->view().format, PixelFormat::Yuv420);
    EXPECT_EQ(frame->view().size, kPicture);
    EXPECT_EQ(frame->view().data[0], 255);
    EXPECT_EQ(frame->view().chroma[1].data[0], 128);
    EXPECT_GE(frame->time(), before - 2ms);
    EXPECT_EQ(camera.cameraCounters().delivered, 1U);
    EXPECT_FALSE(camera.next(0ms).has_value());
    EXPECT_EQ(fake.queued(), 4) << "the driver must get the buffer of a decoded picture back";
}

TEST(CameraV4l2Buffers, AJpegForWhichNoBufferIsFreeCountsAsMissedAndNotAsBroken) {
    FakeV4l2 fake;
    fake.formats = {{V4L2_PIX_FMT_MJPEG, {kPicture}}};
    CameraV4l2 camera(fourBuffers(), fake);
    camera.start();
    const std::vector<std::uint8_t> jpeg = whiteJpeg();
    std::vector<Frame> held;
    for (int i = 0; i < 4; ++i) {
        ASSERT_TRUE(fake.deliver({.ageMs = 50 - i, .jpeg = jpeg}));
        auto frame = camera.next(1s);
        ASSERT_TRUE(frame.has_value());
        held.push_back(std::move(*frame));
    }
    ASSERT_TRUE(fake.deliver({.ageMs = 40, .jpeg = jpeg}));
    EXPECT_FALSE(camera.next(0ms).has_value());
    EXPECT_EQ(camera.cameraCounters().missed, 1U);
    EXPECT_EQ(camera.cameraCounters().broken, 0U);
}

TEST(CameraV4l2Buffers, ABrokenJpegIsCounted) {
    FakeV4l2 fake;
    fake.formats = {{V4L2_PIX_FMT_MJPEG, {kPicture}}};
    CameraV4l2 camera(fourBuffers(), fake);
    camera.start();
    fake.deliver();
    EXPECT_FALSE(camera.next(0ms).has_value());
    EXPECT_EQ(camera.cameraCounters().broken, 1U);
    EXPECT_EQ(fake.queued(), 4);
}

}  // namespace
}  // namespace mfar
