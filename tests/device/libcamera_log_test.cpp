#include "hal/device/libcamera_log.h"
#include "hal/device/libcamera_manager.h"

#include <cstdlib>
#include <gmock/gmock.h>
#include <libcamera/logging.h>
#include <string>
#include <vector>

namespace mfar {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(LibcameraLog, TheTimeAndThreadOfAMessageAreRemoved) {
    const LibcameraMessage message =
        libcameraMessage("[0:12:34.567891234] [4711] ERROR DmaBufAllocator "
                         "dma_buf_allocator.cpp:119 Could not open");
    EXPECT_EQ(message.event, "ERROR DmaBufAllocator dma_buf_allocator.cpp:119");
    EXPECT_EQ(message.text, "DmaBufAllocator dma_buf_allocator.cpp:119 Could not open");
}

TEST(LibcameraLog, ALevelMayBePaddedWithASpace) {
    EXPECT_EQ(libcameraMessage("[0:00:01.0] [1]  WARN IPA ipa.cpp:1 No IPA").event,
              "WARN IPA ipa.cpp:1");
}

TEST(LibcameraLog, TheDeviceBelongsToTheEventAndItsDescriptorDoesNot) {
    const auto event = [](const std::string& message) {
        return libcameraMessage("[0:00:01.0] [1] ERROR V4L2 v4l2.cpp:7 " + message).event;
    };
    EXPECT_EQ(event("/dev/video0[17:cap]: Cannot start"), "ERROR V4L2 v4l2.cpp:7 /dev/video0");
    EXPECT_EQ(event("/dev/video1: No such device"), "ERROR V4L2 v4l2.cpp:7 /dev/video1");
    EXPECT_EQ(event("/dev/video1"), "ERROR V4L2 v4l2.cpp:7 /dev/video1");
    EXPECT_EQ(event("'imx219 10-0010': Cannot start"), "ERROR V4L2 v4l2.cpp:7 'imx219 10-0010'");
    EXPECT_EQ(event("'imx219"), "ERROR V4L2 v4l2.cpp:7");
    EXPECT_EQ(event("Buffer 3: late"), "ERROR V4L2 v4l2.cpp:7");
}

TEST(LibcameraLog, LinesOfAnotherFormStayWhole) {
    for (const char* line : {"", "[", "ERROR", "[1] ", "ERROR IPA ", "assertion failed in foo bar",
                             "[1] [2] assertion failed in foo bar"}) {
        EXPECT_EQ(libcameraMessage(line).text, line);
        EXPECT_EQ(libcameraMessage(line).event, line);
    }
}

TEST(LibcameraLog, NothingIsReceivedIfTheUserHasSetTheLevels) {
    setenv("LIBCAMERA_LOG_LEVELS", "*:INFO", 1);
    std::vector<std::string> texts;
    const LibcameraLog log([&](const LibcameraMessage& message) { texts.push_back(message.text); });
    (void)libcameraManager();
    EXPECT_THAT(texts, IsEmpty());
}

TEST(LibcameraLog, MessagesReachTheReceiverAsLongAsTheLogLives) {
    unsetenv("LIBCAMERA_LOG_LEVELS");
    unsetenv("LIBCAMERA_LOG_FILE");
    std::vector<std::string> texts;
    {
        const LibcameraLog log(
            [&](const LibcameraMessage& message) { texts.push_back(message.text); });
        // libcamera knows the category "Camera" only after its first start.
        (void)libcameraManager();
        libcamera::logSetLevel("Camera", "INFO");
        (void)libcameraManager();
        EXPECT_THAT(texts, Contains(testing::AllOf(StartsWith("Camera camera_manager.cpp:"),
                                                   HasSubstr(" libcamera v"))));
    }
    texts.clear();
    (void)libcameraManager();
    EXPECT_THAT(texts, IsEmpty());
}

}  // namespace
}  // namespace mfar
