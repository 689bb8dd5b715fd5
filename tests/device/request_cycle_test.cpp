#include "hal/device/request_cycle.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace mfar {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPatience{10'000}, kLong{60'000};
constexpr std::size_t kRequests = 4;

/// Completes requests in the test's thread, when the test calls fill(). libcamera completes them in
/// a thread of its own.
class FakeDriver final : public RequestDriver {
public:
    explicit FakeDriver(const RestartLimits& limits = {}) : cycle(*this, limits) {
        for (std::size_t i = 0; i < kRequests; ++i)
            cycle.add();
        cycle.setName("camera 'fake'");
    }

    void start() override {
        const std::lock_guard lock(mutex_);
        starts_.push_back(Timestamp::now());
        changed_.notify_all();
    }
    int queue(std::size_t request) override {
        const std::lock_guard lock(mutex_);
        queued_.push_back(request);
        changed_.notify_all();
        return queueError;
    }
    void prepareStop() override {}
    void stop() override {
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return !hangs_; });
        }
        cancelAll();
    }

    void fill() {
        std::unique_lock lock(mutex_);
        ASSERT_TRUE(changed_.wait_for(lock, kPatience, [&] { return !queued_.empty(); }));
        const std::size_t request = queued_.front();
        queued_.pop_front();
        lock.unlock();
        cycle.completed(request,
                        [&] { return RequestCycle::Done{request, Timestamp{++pictures_}}; });
    }
    void cancelAll() {
        std::unique_lock lock(mutex_);
        const std::deque<std::size_t> all = std::exchange(queued_, {});
        lock.unlock();
        for (const std::size_t request : all)
            cycle.cancelled(request);
    }
    void hang(bool does) {
        const std::lock_guard lock(mutex_);
        hangs_ = does;
        changed_.notify_all();
    }
    [[nodiscard]] std::vector<Timestamp> starts() const {
        const std::lock_guard lock(mutex_);
        return starts_;
    }

    RequestCycle cycle;
    std::atomic<int> queueError{0};

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::size_t> queued_;
    std::vector<Timestamp> starts_;
    std::int64_t pictures_ = 0;
    bool hangs_ = false;
};

/// With this limit, a cancellation of all requests never counts as early.
constexpr RestartLimits kPatient{.early = milliseconds(0)};

bool takes(FakeDriver& camera, std::int64_t number) {
    camera.fill();
    const auto done = camera.cycle.next(kPatience);
    if (!done || done->time.ns != number) return false;
    camera.cycle.giveBack(done->request);
    return true;
}

TEST(RequestCycle, CompletedRequestsAreQueuedAgain) {
    FakeDriver camera;
    camera.cycle.start();
    for (int i = 1; i <= 3 * static_cast<int>(kRequests); ++i)
        ASSERT_TRUE(takes(camera, i));
    EXPECT_EQ(camera.cycle.delivered(), 3 * kRequests);
    camera.cycle.stop();
    EXPECT_FALSE(camera.cycle.next(kPatience));
}

TEST(RequestCycle, CancellationOfAllRequestsRestartsTheCameraAndIsCounted) {
    FakeDriver camera(kPatient);
    camera.cycle.start();
    for (int i = 1; i <= 20; ++i) {
        ASSERT_TRUE(takes(camera, i));
        camera.cancelAll();
        EXPECT_FALSE(camera.cycle.next(kPatience));
        EXPECT_EQ(camera.cycle.restarts(), static_cast<std::uint64_t>(i));
        EXPECT_EQ(camera.starts().size(), static_cast<std::size_t>(i) + 1);
    }
    EXPECT_TRUE(takes(camera, 21));
}

/// Runs `call` in another thread, then `wake` while that thread waits. Returns false if this does
/// not end the wait.
bool wakes(const std::function<void()>& call, const std::function<void()>& wake) {
    auto waiting = std::async(std::launch::async, call);
    EXPECT_EQ(waiting.wait_for(milliseconds(20)), std::future_status::timeout);
    wake();
    return waiting.wait_for(kLong / 2) == std::future_status::ready;
}

TEST(RequestCycle, ACompletedRequestWakesTheWaitingReader) {
    FakeDriver camera;
    camera.cycle.start();
    EXPECT_TRUE(wakes([&] { EXPECT_TRUE(camera.cycle.next(kLong)); }, [&] { camera.fill(); }));
}

TEST(RequestCycle, StopWakesTheWaitingReader) {
    FakeDriver camera;
    camera.cycle.start();
    EXPECT_TRUE(
        wakes([&] { EXPECT_FALSE(camera.cycle.next(kLong)); }, [&] { camera.cycle.stop(); }));
}

TEST(RequestCycle, ALossWakesTheWaitingReader) {
    FakeDriver camera;
    camera.cycle.start();
    EXPECT_TRUE(wakes([&] { EXPECT_THROW((void)camera.cycle.next(kLong), DeviceLost); },
                      [&] { camera.cycle.lose("unplugged"); }));
}

TEST(RequestCycle, CancellationOfAllRequestsWakesTheWaitingReader) {
    FakeDriver camera(kPatient);
    camera.cycle.start();
    EXPECT_TRUE(
        wakes([&] { EXPECT_FALSE(camera.cycle.next(kLong)); }, [&] { camera.cancelAll(); }));
    EXPECT_EQ(camera.cycle.restarts(), 1U);
}

TEST(RequestCycle, ReadyPicturesAreDeliveredBeforeTheRestart) {
    FakeDriver camera(kPatient);
    camera.cycle.start();
    camera.fill();
    camera.cancelAll();
    const auto done = camera.cycle.next(kPatience);
    ASSERT_TRUE(done);
    EXPECT_EQ(camera.cycle.restarts(), 0U);
    camera.cycle.giveBack(done->request);
}

TEST(RequestCycle, CancellationOfSomeRequestsDoesNotRestartTheCamera) {
    FakeDriver camera(kPatient);
    camera.cycle.start();
    camera.cycle.cancelled(0);
    EXPECT_FALSE(camera.cycle.next(milliseconds(5)));
    EXPECT_EQ(camera.cycle.restarts(), 0U);
}

TEST(RequestCycle, PausesBeforeRestartsGrowUntilTheDeviceCountsAsLost) {
    constexpr RestartLimits kLimits{
        .early = milliseconds(60'000), .firstPause = milliseconds(10), .most = 5};
    FakeDriver camera(kLimits);
    camera.cycle.start();
    std::string why;
    for (int i = 0; i < kLimits.most && why.empty(); ++i) {
        camera.cancelAll();
        try {
            EXPECT_FALSE(camera.cycle.next(kPatience));
        } catch (const DeviceLost& lost) {
            why = lost.what();
        }
    }
    EXPECT_EQ(why, "camera 'fake' stopped by itself 5 times in a row, each time within 60000 ms of "
                   "its start");
    EXPECT_EQ(camera.cycle.restarts(), 4U);
    const std::vector<Timestamp> starts = camera.starts();
    ASSERT_EQ(starts.size(), 5U);
    for (std::size_t i = 2; i < starts.size(); ++i)
        EXPECT_GE(starts[i] - starts[i - 1], kLimits.firstPause * (1 << (i - 2)));
    EXPECT_THROW((void)camera.cycle.next(kPatience), DeviceLost);
}

TEST(RequestCycle, ASecondCancellationBeforeTheRestartIsNotCounted) {
    constexpr RestartLimits kLimits{
        .early = milliseconds(60'000), .firstPause = milliseconds(0), .most = 2};
    FakeDriver camera(kLimits);
    camera.cycle.start();
    camera.fill();
    const auto done = camera.cycle.next(kPatience);
    ASSERT_TRUE(done);
    camera.cancelAll();
    camera.cycle.giveBack(done->request);
    camera.cancelAll();
    EXPECT_FALSE(camera.cycle.next(kPatience));
    EXPECT_EQ(camera.cycle.restarts(), 1U);
    EXPECT_TRUE(takes(camera, 2));
}

TEST(RequestCycle, WaitingForAPictureTimesOutDuringThePauseBeforeARestart) {
    constexpr RestartLimits kLimits{
        .early = milliseconds(60'000), .firstPause = milliseconds(60'000), .most = 5};
    FakeDriver camera(kLimits);
    camera.cycle.start();
    camera.cancelAll();
    EXPECT_FALSE(camera.cycle.next(kPatience));
    camera.cancelAll();
    const Timestamp asked = Timestamp::now();
    EXPECT_FALSE(camera.cycle.next(milliseconds(1)));
    EXPECT_LT(Timestamp::now() - asked, kPatience);
    EXPECT_EQ(camera.cycle.restarts(), 1U);
    camera.cycle.stop();
    EXPECT_FALSE(camera.cycle.next(kPatience));
}

// One driver thread serves all cameras. So a hanging restart must not block this thread.
TEST(RequestCycle, AHangingRestartDoesNotDelayTheOtherCamera) {
    FakeDriver ill(kPatient), sound(kPatient);
    ill.cycle.start();
    sound.cycle.start();
    ill.hang(true);
    ill.cancelAll();
    std::thread reader([&] { EXPECT_FALSE(ill.cycle.next(kPatience)); });
    for (int i = 1; i <= 50; ++i) {
        EXPECT_TRUE(takes(sound, i));
        ill.cycle.cancelled(0);  // the driver can report a cancelled request even during a restart
    }
    EXPECT_EQ(ill.starts().size(), 1U);
    ill.hang(false);
    reader.join();
    EXPECT_EQ(ill.starts().size(), 2U);
    EXPECT_EQ(ill.cycle.restarts(), 1U);
    EXPECT_TRUE(takes(ill, 1));
}

TEST(RequestCycle, ADeviceWhoseDriverRefusesARequestIsLost) {
    FakeDriver camera;
    camera.cycle.start();
    camera.queueError = -19;
    camera.fill();
    const auto done = camera.cycle.next(kPatience);
    ASSERT_TRUE(done);
    camera.cycle.giveBack(done->request);
    EXPECT_THROW((void)camera.cycle.next(kPatience), DeviceLost);
}

TEST(RequestCycle, RequestsReturnedAfterCloseAreIgnored) {
    FakeDriver camera;
    camera.cycle.start();
    camera.fill();
    const auto done = camera.cycle.next(kPatience);
    ASSERT_TRUE(done);
    camera.cycle.stop();
    camera.cycle.close();
    camera.queueError = -19;
    camera.cycle.giveBack(done->request);
    EXPECT_FALSE(camera.cycle.next(milliseconds(1)));
}

}  // namespace
}  // namespace mfar
