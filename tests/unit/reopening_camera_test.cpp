#include "hal/reopening_camera.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <functional>
#include <stdexcept>
#include <thread>

namespace mfar {
namespace {

using std::chrono::milliseconds;

/// A simulated device that can be unplugged. It must outlive its cameras. Thread-safe.
struct Socket {
    std::atomic<bool> plugged{true};
    std::atomic<bool> sends{true};
    std::atomic<int> asked{0}, open{0}, opened{0};
    std::atomic<bool> opens{true};    ///< false: the camera's constructor does not return
    std::atomic<bool> closes{true};   ///< false: the camera's destructor does not return
    std::atomic<bool> answers{true};  ///< false: next() and stop() do not return
    Size size{4, 2};
};

class PluggedCamera final : public Camera {
public:
    explicit PluggedCamera(Socket& socket) : socket_(socket) {
        if (!socket_.plugged) throw std::runtime_error("there is no such device");
        ++socket_.asked;
        while (!socket_.opens)
            std::this_thread::sleep_for(milliseconds(1));
        ++socket_.opened;
        if (++socket_.open > 1) throw std::logic_error("opened twice at a time");
    }
    PluggedCamera(const PluggedCamera&) = delete;
    PluggedCamera& operator=(const PluggedCamera&) = delete;
    ~PluggedCamera() override {
        while (!socket_.closes)
            std::this_thread::sleep_for(milliseconds(1));
        --socket_.open;
    }
    [[nodiscard]] CameraInfo info() const override {
        return {"plugged", socket_.size, PixelFormat::Gray8, 30};
    }
    void start() override {}
    [[nodiscard]] std::optional<Frame> next(milliseconds timeout) override {
        waitForAnswer();
        if (!socket_.plugged) throw DeviceLost("it has gone");
        if (socket_.sends) {
            std::this_thread::sleep_for(milliseconds(1));
            return Frame({pixels_.data(), socket_.size, 4, PixelFormat::Gray8}, Timestamp::now(),
                         {});
        }
        std::this_thread::sleep_for(std::min(timeout, milliseconds(5)));
        return std::nullopt;
    }
    void stop() override { waitForAnswer(); }
    [[nodiscard]] bool ended() const override { return false; }
    [[nodiscard]] CameraCounters cameraCounters() const override {
        CameraCounters out;
        out.missed = 3;
        out.broken = 1;
        return out;
    }
    [[nodiscard]] std::vector<std::string> takeWarnings() override { return {"it is old"}; }

private:
    void waitForAnswer() {
        while (!socket_.answers)
            std::this_thread::sleep_for(milliseconds(1));
    }

    Socket& socket_;
    std::array<std::uint8_t, 8> pixels_{};
};

ReopeningOptions quick() {
    return {milliseconds(30), milliseconds(80), milliseconds(2), milliseconds(8)};
}

ReopeningCamera cameraOn(Socket& socket, const ReopeningOptions& options = quick()) {
    return {{"video camera", {4, 2}, PixelFormat::Gray8, 30},
            [&] { return std::make_unique<PluggedCamera>(socket); },
            options};
}

/// Fetches frames until `done` returns true. Returns false after five seconds.
bool drivenUntil(ReopeningCamera& camera, const std::function<bool(bool frame)>& done) {
    const Timestamp end = Timestamp::now() + std::chrono::seconds(5);
    while (Timestamp::now() < end)
        if (done(camera.next(milliseconds(5)).has_value())) return true;
    return false;
}

TEST(ReopeningCamera, AMissingCameraIsReportedAndUsedWhenItAppears) {
    Socket socket;
    socket.plugged = false;
    ReopeningCamera camera = cameraOn(socket);
    camera.start();
    EXPECT_TRUE(drivenUntil(
        camera, [&](bool) { return camera.fault() == "video camera: there is no such device"; }));
    socket.plugged = true;
    EXPECT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    EXPECT_EQ(camera.fault(), std::nullopt);
    EXPECT_EQ(camera.losses(), 0U);
}

TEST(ReopeningCamera, ACameraIsReopenedAfterEachOfManyLosses) {
    Socket socket;
    ReopeningCamera camera = cameraOn(socket);
    camera.start();
    for (int i = 0; i < 20; ++i) {
        ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; })) << i;
        EXPECT_EQ(camera.fault(), std::nullopt);
        socket.plugged = false;
        ASSERT_TRUE(drivenUntil(camera, [&](bool) { return camera.fault().has_value(); })) << i;
        ASSERT_TRUE(drivenUntil(camera, [&](bool) { return socket.open == 0; })) << i;
        socket.plugged = true;
    }
    EXPECT_EQ(camera.losses(), 20U);
}

TEST(ReopeningCamera, ASilentCameraIsReportedAndThenReopened) {
    Socket socket;
    ReopeningCamera camera = cameraOn(socket);
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    socket.sends = false;
    ASSERT_TRUE(drivenUntil(camera, [&](bool) { return camera.fault().has_value(); }));
    EXPECT_EQ(camera.fault(), "video camera: sends no pictures");
    EXPECT_TRUE(drivenUntil(camera, [&](bool) { return socket.opened >= 3; }));
    socket.sends = true;
    EXPECT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    EXPECT_EQ(camera.fault(), std::nullopt);
}

TEST(ReopeningCamera, WhileAnotherDeviceDelaysFramesASilentCameraIsNotYetReopened) {
    Socket socket;
    std::atomic<bool> busy{true};
    ReopeningOptions options = quick();
    options.busyElsewhere = [&] { return busy.load(); };
    options.excused = std::chrono::hours(1);
    ReopeningCamera camera = cameraOn(socket, options);
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    EXPECT_FALSE(camera.absent());
    socket.sends = false;
    const Timestamp end = Timestamp::now() + milliseconds(300);
    while (Timestamp::now() < end)
        EXPECT_FALSE(camera.next(milliseconds(5)));
    EXPECT_EQ(camera.fault(), "video camera: sends no pictures");
    EXPECT_EQ(camera.losses(), 0U);
    busy = false;
    EXPECT_TRUE(drivenUntil(camera, [&](bool) { return camera.losses() > 0; }));
}

TEST(ReopeningCamera, TheExcuseDoesNotShortenTheLimitOfASlowCamera) {
    Socket socket;
    ReopeningOptions options = quick();
    options.busyElsewhere = [] { return true; };
    options.stalled = std::chrono::hours(1);
    options.excused = milliseconds(20);
    ReopeningCamera camera = cameraOn(socket, options);
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    socket.sends = false;
    ASSERT_TRUE(drivenUntil(camera, [&](bool) { return camera.fault().has_value(); }));
    const Timestamp end = Timestamp::now() + milliseconds(200);
    while (Timestamp::now() < end)
        EXPECT_FALSE(camera.next(milliseconds(5)));
    EXPECT_EQ(camera.losses(), 0U);
}

TEST(ReopeningCamera, ASlowlyClosingDeviceDelaysNoThread) {
    Socket socket;
    ReopeningCamera camera = cameraOn(socket);
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    socket.closes = false;
    socket.plugged = false;
    const Timestamp begin = Timestamp::now();
    while (!camera.absent())
        EXPECT_FALSE(camera.next(milliseconds(5)));
    EXPECT_FALSE(camera.next(milliseconds(5)));
    EXPECT_LT(Timestamp::now() - begin, std::chrono::seconds(30));
    EXPECT_EQ(socket.open, 1);
    socket.closes = true;
    socket.plugged = true;
    EXPECT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
}

TEST(ReopeningCamera, AHangingDriverIsReportedAndStopDoesNotWaitForIt) {
    Socket socket;
    ReopeningOptions options = quick();
    options.silent = milliseconds(0);  // silence is no fault of a triggered camera
    ReopeningCamera camera = cameraOn(socket, options);
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    EXPECT_EQ(camera.fault(), std::nullopt);
    socket.answers = false;
    std::jthread asker([&] { (void)camera.next(milliseconds(5)); });
    const Timestamp end = Timestamp::now() + std::chrono::seconds(5);
    while (!camera.fault() && Timestamp::now() < end)
        std::this_thread::sleep_for(milliseconds(1));
    EXPECT_EQ(camera.fault(), "video camera: its driver does not answer");
    socket.answers = true;
    asker.join();
    ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    EXPECT_EQ(camera.fault(), std::nullopt);

    socket.answers = false;
    std::atomic<bool> stopped{false};
    std::jthread stopper([&] {
        camera.stop();
        stopped = true;
    });
    for (const Timestamp limit = Timestamp::now() + std::chrono::seconds(20);
         !stopped && Timestamp::now() < limit;)
        std::this_thread::sleep_for(milliseconds(1));
    EXPECT_TRUE(stopped);
    socket.answers = true;
}

/// A watchdog of a ReopeningCamera's opening thread, whose time budget is 10 s. lateAfter() lets
/// `time` pass and returns the threads that are over their budget.
struct WatchedOpener {
    [[nodiscard]] std::vector<std::string> lateAfter(std::chrono::seconds time) {
        passed = passed.load() + time.count();
        std::vector<std::string> out;
        for (const Heartbeats::Late& late : hearts.late())
            out.push_back(late.thread);
        return out;
    }
    [[nodiscard]] ReopeningOptions options() {
        ReopeningOptions options = quick();
        options.opener = {&hearts, "opener", std::chrono::seconds(10)};
        return options;
    }

    std::atomic<std::int64_t> passed{0};
    Heartbeats hearts{[this] { return Timestamp::now() + std::chrono::seconds(passed); }};
};

TEST(ReopeningCamera, AnOpenThatNeverReturnsIsOverItsBudget) {
    Socket socket;
    socket.opens = false;
    WatchedOpener watch;
    ReopeningCamera camera = cameraOn(socket, watch.options());
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [&](bool) { return socket.asked == 1; }));
    EXPECT_TRUE(watch.lateAfter(std::chrono::seconds(8)).empty());
    EXPECT_EQ(watch.lateAfter(std::chrono::seconds(8)), std::vector<std::string>{"opener"});
    socket.opens = true;
    ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    EXPECT_TRUE(watch.lateAfter(std::chrono::hours(1)).empty())
        << "the opening thread waits for work, which is no fault";
}

TEST(ReopeningCamera, ACloseThatNeverReturnsIsOverItsBudget) {
    Socket socket;
    WatchedOpener watch;
    ReopeningCamera camera = cameraOn(socket, watch.options());
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    socket.closes = false;
    socket.plugged = false;
    ASSERT_TRUE(drivenUntil(camera, [&](bool) { return camera.absent(); }));
    ASSERT_TRUE(drivenUntil(
        camera, [&](bool) { return !watch.lateAfter(std::chrono::seconds(11)).empty(); }));
    socket.closes = true;
    ASSERT_TRUE(drivenUntil(
        camera, [&](bool) { return watch.lateAfter(std::chrono::seconds(11)).empty(); }));
    socket.plugged = true;
    EXPECT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
}

TEST(ReopeningCamera, AStopThatNeverReturnsIsOverItsBudget) {
    Socket socket;
    WatchedOpener watch;
    ReopeningCamera camera = cameraOn(socket, watch.options());
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
    socket.answers = false;
    camera.stop();
    const auto isLate = [&] { return !watch.lateAfter(std::chrono::seconds(11)).empty(); };
    for (const Timestamp end = Timestamp::now() + std::chrono::seconds(5);
         !isLate() && Timestamp::now() < end;)
        std::this_thread::sleep_for(milliseconds(1));
    EXPECT_TRUE(isLate());
    socket.answers = true;
}

TEST(ReopeningCamera, CountersIncludeEarlierDevices) {
    Socket socket;
    ReopeningCamera camera = cameraOn(socket);
    EXPECT_EQ(camera.cameraCounters().missed, std::nullopt);
    camera.start();
    for (unsigned i = 1; i <= 3; ++i) {
        ASSERT_TRUE(drivenUntil(camera, [](bool frame) { return frame; }));
        EXPECT_EQ(camera.cameraCounters().missed, 3 * i);
        EXPECT_EQ(camera.cameraCounters().broken, i);
        EXPECT_EQ(camera.takeWarnings(), std::vector<std::string>{"it is old"});
        EXPECT_TRUE(camera.takeWarnings().empty());
        socket.plugged = false;
        ASSERT_TRUE(drivenUntil(camera, [&](bool) { return camera.absent(); }));
        EXPECT_EQ(camera.cameraCounters().missed, 3 * i) << "unplugging must not change the count";
        EXPECT_EQ(camera.cameraCounters().reopened, i);
        socket.plugged = true;
    }
}

TEST(ReopeningCamera, ACameraLostBeforeItsFirstFrameIsReopenedSlowly) {
    Socket socket;
    ReopeningOptions options = quick();
    options.firstPause = options.longestPause = std::chrono::hours(1);
    ReopeningCamera camera = cameraOn(socket, options);
    socket.sends = false;
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [&](bool) { return !camera.absent(); }));
    socket.plugged = false;
    ASSERT_TRUE(drivenUntil(camera, [&](bool) { return camera.absent(); }));
    socket.plugged = true;
    const Timestamp end = Timestamp::now() + milliseconds(100);
    while (Timestamp::now() < end)
        EXPECT_FALSE(camera.next(milliseconds(5)));
    EXPECT_EQ(socket.opened, 1);
    EXPECT_EQ(camera.fault(), "video camera: it has gone");
}

TEST(ReopeningCamera, ASilentTriggeredCameraIsNoFault) {
    Socket socket;
    socket.sends = false;
    ReopeningOptions options = quick();
    options.silent = milliseconds(0);
    ReopeningCamera camera = cameraOn(socket, options);
    camera.start();
    ASSERT_TRUE(drivenUntil(camera, [&](bool) { return !camera.fault(); }));
    const Timestamp end = Timestamp::now() + milliseconds(200);
    while (Timestamp::now() < end) {
        EXPECT_FALSE(camera.next(milliseconds(5)).has_value());
        EXPECT_EQ(camera.fault(), std::nullopt);
    }
    EXPECT_EQ(socket.opened, 1);
}

TEST(ReopeningCamera, ACameraOfAnotherSizeCountsAsMissing) {
    Socket socket;
    socket.size = {2, 2};
    ReopeningCamera camera = cameraOn(socket);
    camera.start();
    EXPECT_TRUE(drivenUntil(camera, [&](bool) {
        return camera.fault() == "video camera: delivers pictures of 2x2 instead of 4x2";
    }));
    EXPECT_EQ(socket.open, 0);
}

TEST(ReopeningCamera, StopWakesWaitingThreads) {
    Socket socket;
    socket.plugged = false;
    ReopeningCamera camera = cameraOn(socket);
    camera.start();
    const Timestamp begin = Timestamp::now();
    std::jthread stopper([&] {
        std::this_thread::sleep_for(milliseconds(20));
        camera.stop();
    });
    EXPECT_FALSE(camera.next(std::chrono::seconds(60)).has_value());
    EXPECT_LT(Timestamp::now() - begin, std::chrono::seconds(30));
    EXPECT_FALSE(camera.next(std::chrono::seconds(60)).has_value());
}

}  // namespace
}  // namespace mfar
