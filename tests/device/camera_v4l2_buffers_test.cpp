#include "hal/device/camera_v4l2.h"
#include "tests/device/fake_v4l2.h"

#include <gtest/gtest.h>

#include <system_error>

#include <cstdint>
#include <filesystem>
#include <future>
#include <string>
#include <thread>
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

}  // namespace
}  // namespace mfar
