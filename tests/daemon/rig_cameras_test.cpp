#include "daemon/budgets.h"
#include "daemon/rig.h"
#include "daemon/rig_trigger.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <malloc.h>
#include <set>
#include <string>
#include <utility>

namespace mfar {
namespace {

using namespace std::chrono_literals;

/// Fires ten pulses whose stills have time stamps `late` after the pulse. Returns the counters.
StillCounters countersOf(const TriggerLineConfig& line, std::chrono::nanoseconds late) {
    StillMatcher matcher(stillOptions(line).matching);
    for (int i = 0; i < 10; ++i) {
        const Timestamp pulse = Timestamp{} + (i + 1) * 10s;
        matcher.pulseFired(pulse);
        (void)matcher.stillArrived(pulse + late);
    }
    return matcher.counters();
}

TEST(StillOptions, ALargeJitterIsToleratedFromTheFirstStillOn) {
    TriggerLineConfig line;
    line.jitterMs = 300;
    EXPECT_EQ(countersOf(line, 150ms).matched, 10U);
    line.jitterMs = 1;
    EXPECT_EQ(countersOf(line, 150ms).matched, 5U);
}

TEST(StillOptions, AStillIsNotLostDuringItsExposure) {
    TriggerLineConfig line;
    line.pulseMs = 2000;
    line.pulseIsExposure = true;
    line.arrivalMs = 500;
    StillMatcher matcher(stillOptions(line).matching);
    matcher.pulseFired(Timestamp{});
    EXPECT_EQ(matcher.poll(Timestamp{} + 2400ms).lost, 0);
    EXPECT_EQ(matcher.poll(Timestamp{} + 2600ms).lost, 1);
}

class RigOfCameras : public testing::Test {
protected:
    RigOfCameras() {
        setenv("MFAR_PRETENDED_V4L2", folder_.path().c_str(), 1);
        config_.source = "cameras";
        config_.cameras.video = camera("/dev/video90", {64, 48}, 30);
        config_.cameras.still = camera("/dev/video91", {128, 96}, 5);
    }
    ~RigOfCameras() override { unsetenv("MFAR_PRETENDED_V4L2"); }

    static CameraConfig camera(const char* device, Size size, double rateHz) {
        CameraConfig out;
        out.driver = CameraDriver::V4l2;
        out.camera = device;
        out.size = size;
        out.rateHz = rateHz;
        return out;
    }
    /// Sets how the simulated `device` behaves from now on, see tests/device/pretended_v4l2.cpp.
    void says(const std::string& device, const std::string& words) const {
        const std::filesystem::path next = folder_.path() / "next";
        std::ofstream(next) << words;
        std::filesystem::rename(next, folder_.path() / device);
    }

    test::TempFolder folder_;
    Config config_;
};

bool becomesTrue(const std::function<bool()>& condition) {
    for (const auto end = std::chrono::steady_clock::now() + 20s;
         std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(1ms))
        if (condition()) return true;
    return false;
}

// data.csv is a pipe without a reader; so opening it never returns.
TEST_F(RigOfCameras, ARecorderWhoseDiskHangsIsReportedAsLate) {
    says("video90", "");
    std::atomic<std::int64_t> passed{0};
    Heartbeats hearts([&] { return Timestamp::now() + std::chrono::seconds(passed); });
    Rig rig(config_, hearts);
    const std::filesystem::path recording = folder_ / "recording",
                                csv = recording / "cam0/data.csv";
    rig.startRecording(rig.makeRecording(recording)());
    std::filesystem::remove(csv);
    ASSERT_EQ(mkfifo(csv.c_str(), 0600), 0);
    rig.video().start();
    EXPECT_TRUE(becomesTrue([&] {
        if (const std::optional<Frame> frame = rig.video().next(50ms)) rig.recordVideo(*frame);
        passed = passed.load() + std::chrono::ceil<std::chrono::seconds>(budget::kWriter).count();
        const auto late = hearts.late();
        return late.size() == 1 && late.front().thread == "recorder" &&
               late.front().role == ThreadRole::Helper;
    }));
    std::ifstream reader(csv);
    rig.finishRecording();
    EXPECT_TRUE(becomesTrue([&] { return hearts.late().empty(); }))
        << "a recorder that waits for work is not late";
}

// The first recording of a rig counts as the recording of --record. If `breaks` is true, record()
// replaces the folder for pictures by a file, so that the pictures cannot be written.
TEST_F(RigOfCameras, OnlyTheRecordingOfTheCommandLineMustBeComplete) {
    says("video90", "");
    config_.recordTo = folder_ / "required";
    Heartbeats hearts;
    const auto recordOne = [](Rig& rig) {
        ASSERT_TRUE(becomesTrue([&] {
            const std::optional<Frame> frame = rig.video().next(50ms);
            if (frame) rig.recordVideo(*frame);
            return frame.has_value();
        }));
    };
    const auto record = [&](Rig& rig, const char* name, bool breaks) {
        rig.startRecording(rig.makeRecording(folder_ / name)());
        if (breaks) {
            std::filesystem::remove_all(folder_ / name / "cam0/data");
            std::ofstream(folder_ / name / "cam0/data") << "no folder";
        }
        recordOne(rig);
    };
    {
        Rig rig(config_, hearts);
        rig.video().start();
        record(rig, "required", true);
        ASSERT_TRUE(becomesTrue([&] { return rig.endBrokenRecording().has_value(); }));
        record(rig, "later", false);
        EXPECT_THROW(rig.finishRecording(), Failure);
    }
    Rig rig(config_, hearts);
    rig.video().start();
    record(rig, "complete", false);
    (void)rig.stopRecording()();
    record(rig, "broken", true);
    EXPECT_NO_THROW(rig.finishRecording());
}

// The file gpiochip0 makes the simulated devices the only ones in /dev. Both cameras offer all
// sizes. Of two equal cameras, the one whose path comes last in the order of paths counts as the
// larger one.
TEST_F(RigOfCameras, IfTheLargerOfTwoUnnamedCamerasIsConnectedFirstTheVideoGivesItUp) {
    config_.cameras.video.camera.clear();
    config_.cameras.still.camera.clear();
    says("gpiochip0", "");
    says("video91", "rate 100");
    Heartbeats hearts;
    Rig rig(config_, hearts);
    rig.video().start();
    rig.still().start();
    ASSERT_TRUE(becomesTrue([&] { return rig.video().next(50ms).has_value(); }));
    says("video90", "rate 100");
    EXPECT_TRUE(becomesTrue([&] {
        (void)rig.video().next(5ms);
        return rig.still().next(5ms).has_value();
    }));
    EXPECT_TRUE(becomesTrue([&] { return rig.video().next(50ms) && !rig.fault(); }));
    EXPECT_EQ(rig.video().cameraCounters().reopened, 1U);
}

/// Open files, threads and allocated bytes of this process.
struct Used {
    static long entries(const char* folder) {
        return std::distance(std::filesystem::directory_iterator(folder), {});
    }
    long files = entries("/proc/self/fd"), threads = entries("/proc/self/task");
    std::size_t bytes = mallinfo2().uordblks;
};

TEST_F(RigOfCameras, AHundredCameraLossesLeakNothing) {
    says("video90", "rate 200");
    Heartbeats hearts;
    Rig rig(config_, hearts);
    rig.video().start();
    const auto comes = [&] { return rig.video().next(50ms).has_value(); };
    std::optional<Used> before;
    for (unsigned i = 1; i <= 100; ++i) {
        ASSERT_TRUE(becomesTrue(comes)) << i;
        if (i == 10) before.emplace();
        says("video90", "rate 200 unplug " + std::to_string(i));
        ASSERT_TRUE(becomesTrue([&] {
            (void)comes();
            return rig.video().cameraCounters().reopened == i;
        })) << i;
    }
    ASSERT_TRUE(becomesTrue(comes));
    const Used after;
    EXPECT_EQ(after.files, before->files);
    EXPECT_EQ(after.threads, before->threads);
    EXPECT_LT(after.bytes, before->bytes + 32'768);
}

TEST_F(RigOfCameras, DriverWithoutBuffersIsReportedUntilItHasSome) {
    says("video90", "buffers 0");
    says("video91", "rate 100");
    Heartbeats hearts;
    Rig rig(config_, hearts);
    rig.video().start();
    rig.still().start();
    EXPECT_TRUE(becomesTrue([&] { return rig.still().next(50ms).has_value(); }));
    EXPECT_TRUE(becomesTrue([&] {
        (void)rig.still().next(50ms);
        return rig.fault() == "video camera: /dev/video90: the driver allocated 0 buffers, "
                              "which is an invalid number";
    })) << rig.fault().value_or("no fault");
    says("video90", "");
    EXPECT_TRUE(becomesTrue([&] { return rig.video().next(50ms).has_value(); }));
    EXPECT_EQ(rig.fault(), std::nullopt);
}

TEST_F(RigOfCameras, ThreadsWhoseDriverNeverOpensTheCameraAreReportedAsLate) {
    says("video90", "hang-open");
    says("video91", "hang-open");
    std::atomic<std::int64_t> passed{0};
    Heartbeats hearts([&] { return Timestamp::now() + std::chrono::seconds(passed); });
    Rig rig(config_, hearts);
    rig.video().start();
    rig.still().start();
    const std::set<std::pair<std::string, ThreadRole>> openers = {
        {"video camera opener", ThreadRole::Vital}, {"still camera opener", ThreadRole::Helper}};
    EXPECT_TRUE(becomesTrue([&] {
        passed = passed.load() + std::chrono::ceil<std::chrono::seconds>(budget::kOpener).count();
        std::set<std::pair<std::string, ThreadRole>> late;
        for (const Heartbeats::Late& one : hearts.late())
            late.emplace(one.thread, one.role);
        return late == openers;
    }));
    says("video90", "");
    says("video91", "");
    EXPECT_TRUE(becomesTrue([&] { return rig.video().next(50ms).has_value(); }));
    EXPECT_TRUE(hearts.late().empty()) << "a thread whose camera is open is not late";
}

}  // namespace
}  // namespace mfar
