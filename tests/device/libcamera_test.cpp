#include "hal/device/camera_libcamera.h"
#include "hal/device/libcamera_manager.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mfar {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

LibcameraOptions unknown() {
    LibcameraOptions options;
    options.camera.name = "no-such-camera";
    options.size = {640, 480};
    return options;
}

// This test passes on every machine, with or without cameras.
TEST(Libcamera, AnUnknownCameraIsReportedWithTheAvailableCameras) {
    const std::vector<ListedCamera> cameras = listLibcameras();
    const std::string expected = cameras.empty() ? "finds no camera" : cameras[0].id;
    EXPECT_THAT([] { LibcameraCamera camera(unknown()); },
                ThrowsMessage<std::runtime_error>(HasSubstr(expected)));
}

TEST(Libcamera, ImpossibleOptionsAreRefusedBeforeADeviceIsLookedFor) {
    const auto refused = [](auto change, const char* message) {
        LibcameraOptions options = unknown();
        change(options);
        EXPECT_THAT([&] { LibcameraCamera camera(options); },
                    ThrowsMessage<std::runtime_error>(HasSubstr(message)));
    };
    refused([](auto& o) { o.size = {641, 480}; }, "641x480");
    refused([](auto& o) { o.size = {0, 0}; }, "0x0");
    refused([](auto& o) { o.rateHz = std::numeric_limits<double>::quiet_NaN(); }, "rate");
    refused([](auto& o) { o.buffers = 1; }, "buffers");
}

TEST(Libcamera, OneManagerIsSharedAndCanBeCreatedAgain) {
    auto first = libcameraManager();
    EXPECT_EQ(first, libcameraManager());
    first.reset();
    EXPECT_NE(libcameraManager(), nullptr);
}

TEST(Libcamera, ManagersOfSeveralThreadsNeverOverlap) {
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([] {
            for (int j = 0; j < 10; ++j)
                EXPECT_NE(libcameraManager(), nullptr);
        });
    for (std::thread& thread : threads)
        thread.join();
}

}  // namespace
}  // namespace mfar
