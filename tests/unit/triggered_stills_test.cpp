#include "hal/triggered_stills.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mfar {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

struct Sensor {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Frame> ready;
    std::vector<Timestamp> pulses;
    int loans = 0;
    int busy = 0;   ///< number of further calls of fire() that throw TriggerBusy
    int blind = 0;  ///< number of further pulses that expose no still
    bool stopped = false;
    int rests = 0;
    bool high = false;  ///< true from a pulse until endPulse()
    nanoseconds exposure{0};
    nanoseconds delay{300us};  ///< time from the pulse to the start of the exposure

    void expose(Timestamp start) {
        ++loans;
        Frame frame({}, start + exposure / 2, [this] { --loans; });
        frame.exposure = exposure;
        ready.push_back(std::move(frame));
        changed.notify_all();
    }
    Timestamp fire() {
        std::lock_guard lock(mutex);
        if (busy > 0) {
            --busy;
            throw TriggerBusy("busy");
        }
        high = true;
        pulses.push_back(Timestamp::now());
        if (blind > 0)
            --blind;
        else
            expose(pulses.back() + delay);
        return pulses.back();
    }
};

class FakeCamera final : public Camera {
public:
    explicit FakeCamera(Sensor& sensor) : sensor_(sensor) {}
    [[nodiscard]] CameraInfo info() const override {
        return {"fake", {2304, 1728}, PixelFormat::Nv12, 30};
    }
    void start() override { sensor_.stopped = false; }
    std::optional<Frame> next(milliseconds timeout) override {
        std::unique_lock lock(sensor_.mutex);
        sensor_.changed.wait_for(lock, timeout,
                                 [&] { return sensor_.stopped || !sensor_.ready.empty(); });
        if (sensor_.stopped || sensor_.ready.empty()) return std::nullopt;
        Frame frame = std::move(sensor_.ready.front());
        sensor_.ready.pop_front();
        return frame;
    }
    void stop() override {
        std::lock_guard lock(sensor_.mutex);
        sensor_.stopped = true;
        sensor_.changed.notify_all();
    }
    [[nodiscard]] bool ended() const override { return false; }

private:
    Sensor& sensor_;
};

class FakeTrigger final : public Trigger {
public:
    explicit FakeTrigger(Sensor& sensor) : sensor_(sensor) {}
    Timestamp fire() override { return sensor_.fire(); }
    void rest() override {
        const std::lock_guard lock(sensor_.mutex);
        ++sensor_.rests;
    }
    void endPulse() override {
        const std::lock_guard lock(sensor_.mutex);
        sensor_.high = false;
    }
    [[nodiscard]] std::string name() const override { return "fake line"; }

private:
    Sensor& sensor_;
};

struct TriggeredStills : testing::Test {
    std::unique_ptr<TriggeredStillCamera> open(TriggeredStillOptions options = {}) {
        options.matching.wideWindow = 1ms;
        auto camera = std::make_unique<TriggeredStillCamera>(
            std::make_unique<FakeCamera>(sensor), std::make_unique<FakeTrigger>(sensor), options);
        camera->start();
        return camera;
    }

    Sensor sensor;
};

TEST_F(TriggeredStills, ReportsThePropertiesOfTheCameraWithoutARate) {
    const auto camera = open();
    EXPECT_EQ(camera->info().name, "fake");
    EXPECT_EQ(camera->info().size, (Size{2304, 1728}));
    EXPECT_EQ(camera->info().rateHz, 0);
    EXPECT_EQ(camera->name(), "fake line");
    EXPECT_FALSE(camera->ended());
}

TEST_F(TriggeredStills, StillHasTheTimeOfItsPulse) {
    sensor.exposure = 8ms;
    const auto camera = open();
    for (int i = 0; i < 30; ++i) {
        const Timestamp edge = camera->fire();
        const auto still = camera->next(10s);
        ASSERT_TRUE(still);
        EXPECT_EQ(still->time(), edge + 300us + 4ms);
        EXPECT_EQ(still->exposure, 8ms);
        std::this_thread::sleep_for(2ms);
    }
    EXPECT_EQ(camera->counters().matched, 30U);
}

TEST_F(TriggeredStills, IfTheCameraReportsNoExposureTheConfiguredExposureIsUsed) {
    TriggeredStillOptions options;
    options.exposure = 6ms;
    const auto camera = open(options);
    const Timestamp edge = camera->fire();
    const auto still = camera->next(10s);
    ASSERT_TRUE(still);
    EXPECT_EQ(still->exposure, 6ms);
    EXPECT_EQ(still->time(), edge + 300us + 3ms);
}

TEST_F(TriggeredStills, TheConfiguredExposureReplacesTheReportedOne) {
    sensor.exposure = 8ms;
    TriggeredStillOptions options;
    options.exposure = 2ms;
    const auto camera = open(options);
    const Timestamp edge = camera->fire();
    const auto still = camera->next(10s);
    ASSERT_TRUE(still);
    EXPECT_EQ(still->exposure, 2ms);
    EXPECT_EQ(still->time(), edge + 300us + 1ms);
}

TEST_F(TriggeredStills, TheLineIsSetInactiveBeforeAnyPulse) {
    const auto camera = open();
    EXPECT_GE(sensor.rests, 1);
    const int before = sensor.rests;
    EXPECT_FALSE(camera->next(1ms));
    EXPECT_GT(sensor.rests, before);
    EXPECT_TRUE(sensor.pulses.empty());
}

TEST_F(TriggeredStills, StillsWithoutAPulseAreReturnedToTheCamera) {
    const auto camera = open();
    {
        std::lock_guard lock(sensor.mutex);
        for (int i = 1; i < 4; ++i)
            sensor.expose(Timestamp::now() - i * 1s);
    }
    EXPECT_FALSE(camera->next(0ms));
    EXPECT_EQ(sensor.loans, 0);
    EXPECT_EQ(camera->counters().unmatched, 3U);
}

TEST_F(TriggeredStills, AFrameReturnsItsBufferAndCanOutliveTheCamera) {
    auto camera = open();
    camera->fire();
    auto still = camera->next(10s);
    ASSERT_TRUE(still);
    camera.reset();
    EXPECT_EQ(sensor.loans, 1);
    still.reset();
    EXPECT_EQ(sensor.loans, 0);
}

TEST_F(TriggeredStills, LostPulseIsRepeatedOnceAndTheStillOfTheRepetitionIsDelivered) {
    sensor.blind = 1;
    TriggeredStillOptions options;
    options.matching.timeout = 5ms;
    const auto camera = open(options);
    camera->fire();
    const auto still = camera->next(10s);
    ASSERT_TRUE(still);
    ASSERT_EQ(sensor.pulses.size(), 2U);
    EXPECT_EQ(still->time(), sensor.pulses[1] + 300us);
    EXPECT_EQ(camera->counters().lost, 1U);
    EXPECT_EQ(camera->counters().repeated, 1U);
}

TEST_F(TriggeredStills, DeadSensorGetsOneRepetitionPerPulse) {
    sensor.blind = 100;
    TriggeredStillOptions options;
    options.matching.timeout = 2ms;
    const auto camera = open(options);
    camera->fire();
    while (camera->counters().lost < 2)
        EXPECT_FALSE(camera->next(1ms));
    EXPECT_FALSE(camera->next(20ms));
    EXPECT_EQ(sensor.pulses.size(), 2U);
}

TEST_F(TriggeredStills, RepetitionIsFiredOnceTheTriggerIsNoLongerBusy) {
    sensor.blind = 1;
    TriggeredStillOptions options;
    options.matching.timeout = 2ms;
    const auto camera = open(options);
    camera->fire();
    sensor.busy = 3;
    EXPECT_TRUE(camera->next(10s));
    EXPECT_EQ(sensor.busy, 0);
    sensor.busy = 1;
    EXPECT_THROW(camera->fire(), TriggerBusy);
}

TEST_F(TriggeredStills, TimesNeverGoBackwards) {
    sensor.blind = 2;
    const auto camera = open();
    const Timestamp first = camera->fire();
    std::this_thread::sleep_for(5ms);
    const Timestamp second = camera->fire();
    {
        std::lock_guard lock(sensor.mutex);
        sensor.expose(second + 300us);
        sensor.expose(first + 300us);
    }
    const auto still = camera->next(10s);
    ASSERT_TRUE(still);
    EXPECT_EQ(still->time(), second + 300us);
    EXPECT_FALSE(camera->next(0ms));
    EXPECT_EQ(camera->counters().matched, 2U);
    EXPECT_EQ(camera->counters().overtaken, 1U);
    EXPECT_EQ(sensor.loans, 1);
}

TEST_F(TriggeredStills, StopWakesTheWaitingThread) {
    const auto camera = open();
    std::thread waiting([&] { EXPECT_FALSE(camera->next(1h)); });
    std::this_thread::sleep_for(5ms);
    camera->stop();
    waiting.join();
}

TEST_F(TriggeredStills, AfterStopTheLineIsInactiveAndNoPulseIsFired) {
    const auto camera = open();
    camera->fire();
    ASSERT_TRUE(sensor.high);
    camera->stop();
    EXPECT_FALSE(sensor.high);
    EXPECT_THROW(camera->fire(), TriggerBusy);
    EXPECT_FALSE(sensor.high);
    camera->start();
    EXPECT_NO_THROW(camera->fire());
}

TEST_F(TriggeredStills, FiringWhileAnotherThreadTakesStillsLosesNoStill) {
    const auto camera = open();
    std::thread firing([&] {
        for (int i = 0; i < 50; ++i) {
            camera->fire();
            std::this_thread::sleep_for(3ms);
        }
    });
    int got = 0;
    while (got < 50) {
        if (camera->next(10s)) ++got;
    }
    firing.join();
    EXPECT_EQ(camera->counters().matched, 50U);
    EXPECT_EQ(camera->counters().unmatched, 0U);
}

}  // namespace
}  // namespace mfar
