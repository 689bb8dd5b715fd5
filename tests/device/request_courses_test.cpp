// Random sequences of a camera's requests on a simulated clock must agree with a model, which
// determines where each request must be. The sequences must not disturb a second camera.
#include "hal/device/request_cycle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace mfar {
namespace {

using std::chrono::milliseconds;

constexpr std::uint32_t kSeeds = 200;
constexpr int kSteps = 200;
constexpr milliseconds kEarly{500};
/// Pauses before the camera is restarted. Index: number of failed starts in a row. A start has
/// failed if all requests are cancelled within kEarly after it. After five failed starts in a row
/// the camera is lost.
constexpr std::array<milliseconds, 5> kPauses = {milliseconds(0), milliseconds(0), milliseconds(50),
                                                 milliseconds(100), milliseconds(200)};

struct Chance {
    explicit Chance(std::uint32_t seed) : random(seed) {}

    [[nodiscard]] std::uint32_t below(std::uint32_t end) {
        return static_cast<std::uint32_t>(random() % end);
    }
    [[nodiscard]] bool oneIn(std::uint32_t times) { return below(times) == 0; }

    std::mt19937 random;
    Timestamp now{1'000'000'000};
};

/// Simulates a driver and the user of its pictures. Each call compares the request cycle with the
/// model.
class ModelledCamera final : public RequestDriver {
public:
    explicit ModelledCamera(Chance& chance)
        : cycle(*this, {}, [&chance] { return chance.now; }), chance_(chance) {
        for (std::size_t i = 0; i < kRequests; ++i)
            cycle.add();
    }

    void start() override {
        EXPECT_FALSE(running_);
        EXPECT_FALSE(isLost);
        ++starts_;
        meanwhile();
        if (std::exchange(startFails, false)) throw std::runtime_error("the camera does not start");
        chance_.now = chance_.now + milliseconds(chance_.below(20));
        begun_ = chance_.now;
        restartAt.reset();
        running_ = true;
    }
    int queue(std::size_t request) override {
        EXPECT_TRUE(running_);
        EXPECT_EQ(at_[request], At::Cycle) << "a request was queued twice: " << request;
        at_[request] = At::Driver;
        isCancelled_[request] = false;
        return 0;
    }
    void prepareStop() override {
        if (running_ && chance_.oneIn(4)) fill(true);
        if (running_ && chance_.oneIn(4)) cancel();
    }
    void stop() override {
        running_ = false;
        while (has(At::Driver)) {
            chance_.now = chance_.now + milliseconds(chance_.below(5));
            chance_.oneIn(2) ? fill(true) : cancel();
            meanwhile();
        }
        for (const std::size_t request : std::exchange(ready_, {}))
            at_[request] = At::Cycle;
    }

    /// Completes one of the driver's requests. `sound`: true if it completes with a picture.
    void fill(bool sound) {
        const auto request = take(At::Driver);
        if (!request) return;
        cycle.completed(*request, [&]() -> std::optional<RequestCycle::Done> {
            if (!sound) return std::nullopt;
            return RequestCycle::Done{*request, chance_.now};
        });
        if (!running_) return;
        if (sound) {
            at_[*request] = At::Ready;
            ready_.push_back(*request);
            ++delivered_;
        }
        isCancelled_ = {};
    }
    void cancel() {
        const auto request = take(At::Driver);
        if (!request) return;
        cycle.cancelled(*request);
        isCancelled_[*request] = true;
        if (!running_ || has(At::Driver) || restartAt) return;
        ends_ = chance_.now - begun_ < kEarly ? ends_ + 1 : 0;
        isLost = isLost || ends_ == kPauses.size();
        if (ends_ == kPauses.size()) return;
        restartAt = chance_.now + kPauses[ends_];
        ++pauses[ends_];
    }
    void cancelAll() {
        while (has(At::Driver))
            cancel();
    }
    void unplug() {
        isLost = true;
        cycle.lose("unplugged");
    }

    void giveBack() {
        const auto request = take(At::User);
        if (!request) return;
        cycle.giveBack(*request);
    }
    [[nodiscard]] bool restartIsDue() const {
        return running_ && !isLost && ready_.empty() && restartAt && chance_.now >= *restartAt;
    }
    void next() {
        const bool restarts = restartIsDue(), ran = running_, fails = startFails;
        const int before = starts_;
        restarts_ += restarts ? 1 : 0;
        try {
            const auto done = nextUntilStopped();
            EXPECT_TRUE(restarts || !isLost);
            ASSERT_EQ(done.has_value(), ran && !ready_.empty());
            if (done) {
                EXPECT_EQ(done->request, ready_.front());
                ready_.pop_front();
                at_[done->request] = At::User;
            }
        } catch (const DeviceLost&) {
            EXPECT_TRUE(isLost);
        } catch (const std::runtime_error&) {
            EXPECT_TRUE(restarts && fails);
        }
        EXPECT_TRUE(isLost || starts_ - before == (restarts ? 1 : 0));
    }
    /// Calls stop() from another thread during a restart. That thread must wait for the end of the
    /// restart.
    void stopInThread() {
        if (stopper_.joinable()) return;
        stopper_ = std::thread([this] { cycle.stop(); });
        ++threadedStops;
    }
    void startByUser() {
        const bool fails = startFails && !running_;
        try {
            cycle.start();
            EXPECT_FALSE(fails);
            EXPECT_TRUE(running_);
        } catch (const DeviceLost&) {
            EXPECT_TRUE(isLost);
        } catch (const std::runtime_error&) {
            EXPECT_TRUE(fails);
        }
    }
    void stopByUser() {
        cycle.stop();
        EXPECT_FALSE(running_);
        EXPECT_FALSE(has(At::Driver));
    }

    /// Compares the cycle with the model. A request must be held by the driver or the user, or be
    /// ready, or be cancelled. Otherwise it is lost.
    void check() const {
        EXPECT_EQ(cycle.restarts(), restarts_);
        EXPECT_EQ(cycle.delivered(), delivered_);
        if (!running_ || isLost) return;
        for (std::size_t i = 0; i < kRequests; ++i)
            EXPECT_TRUE(at_[i] != At::Cycle || isCancelled_[i]) << "a request was lost: " << i;
        EXPECT_TRUE(has(At::Driver) || has(At::Ready) || has(At::User) || restartAt);
    }
    void close() {
        cycle.stop();
        cycle.close();
        while (has(At::User))
            giveBack();
        EXPECT_FALSE(has(At::Driver));
    }

    static constexpr std::size_t kRequests = 4;
    RequestCycle cycle;
    std::function<void()> meanwhile = [] {};
    bool startFails = false;
    bool isLost = false;
    std::optional<Timestamp> restartAt;
    std::array<int, kPauses.size()> pauses{};
    int threadedStops = 0;

private:
    enum class At : std::uint8_t { Cycle, Driver, Ready, User };

    [[nodiscard]] std::optional<RequestCycle::Done> nextUntilStopped() {
        struct Join {
            std::thread& thread;
            ~Join() {
                if (thread.joinable()) thread.join();
            }
        };
        const Join whenDone{stopper_};
        return cycle.next(milliseconds(0));
    }
    [[nodiscard]] bool has(At where) const { return std::ranges::find(at_, where) != at_.end(); }
    /// Moves a random request from `where` to the request cycle. Returns the request's index; empty
    /// if `where` has no request.
    std::optional<std::size_t> take(At where) {
        std::vector<std::size_t> those;
        for (std::size_t i = 0; i < kRequests; ++i)
            if (at_[i] == where) those.push_back(i);
        if (those.empty()) return std::nullopt;
        const std::size_t one = those[chance_.below(static_cast<std::uint32_t>(those.size()))];
        at_[one] = At::Cycle;
        return one;
    }

    Chance& chance_;
    std::thread stopper_;
    std::array<At, kRequests> at_{};
    std::array<bool, kRequests> isCancelled_{};  ///< true: was cancelled and not queued since
    std::deque<std::size_t> ready_;
    bool running_ = false;
    Timestamp begun_;
    std::size_t ends_ = 0;
    int starts_ = 0;
    std::uint64_t delivered_ = 0, restarts_ = 0;
};

struct Seen {
    std::array<int, kPauses.size()> pauses{};
    int lost = 0, failedStarts = 0, stopsInRestarts = 0;
};

class Course {
public:
    explicit Course(std::uint32_t seed) : chance_(seed), ill_(chance_), sound_(chance_) {
        ill_.meanwhile = [this] { happenMeanwhile(); };
        cancelsAll_ = 3 + chance_.below(20);
    }

    void run(Seen& seen) {
        sound_.startByUser();
        ill_.startByUser();
        for (int i = 0; i < kSteps && !testing::Test::HasFailure(); ++i) {
            pass();
            step(seen);
            ill_.check();
            serveOther();
        }
        seen.lost += ill_.isLost ? 1 : 0;
        seen.stopsInRestarts += ill_.threadedStops;
        for (std::size_t i = 0; i < kPauses.size(); ++i)
            seen.pauses[i] += ill_.pauses[i];
        ill_.close();
        sound_.close();
    }

private:
    void pass() {
        milliseconds more(chance_.below(8));
        if (chance_.oneIn(60)) more = kEarly;
        const Timestamp later = chance_.now + more;
        chance_.now = later;
        if (!ill_.restartAt || !chance_.oneIn(3)) return;
        const Timestamp justBefore = *ill_.restartAt - std::chrono::nanoseconds(1);
        chance_.now = std::max(later, chance_.oneIn(2) ? justBefore : *ill_.restartAt);
    }

    void step(Seen& seen) {
        if (chance_.oneIn(cancelsAll_)) ill_.cancelAll();
        switch (chance_.below(12)) {
        case 0:
        case 1:
        case 2: return ill_.fill(!chance_.oneIn(4));
        case 3: return ill_.cancel();
        case 4:
        case 5: return ill_.giveBack();
        case 6: return breakSomething(seen);
        default: return next();
        }
    }
    void breakSomething(Seen& seen) {
        const std::uint32_t what = chance_.below(10);
        if (what == 0) ill_.stopByUser();
        if (what <= 3) ill_.startByUser();
        if (what == 4) {
            ill_.startFails = true;
            ++seen.failedStarts;
        }
        if (what == 5 && chance_.oneIn(20)) ill_.unplug();
    }
    void next() {
        restarts_ = ill_.restartIsDue();
        ill_.next();
        restarts_ = false;
    }

    /// Runs while the faulty camera starts or stops, in the thread that does this.
    void happenMeanwhile() {
        serveOther();
        if (chance_.oneIn(4)) ill_.giveBack();
        if (chance_.oneIn(1000)) ill_.unplug();
        if (restarts_ && chance_.oneIn(10)) ill_.stopInThread();
    }
    void serveOther() {
        sound_.fill(true);
        sound_.next();
        sound_.giveBack();
        sound_.check();
        EXPECT_EQ(sound_.cycle.delivered(), ++served_);
        EXPECT_EQ(sound_.cycle.restarts(), 0U);
    }

    Chance chance_;
    ModelledCamera ill_, sound_;
    /// Average number of steps between cancellations of all requests.
    std::uint32_t cancelsAll_ = 0;
    bool restarts_ = false;
    std::uint64_t served_ = 0;
};

TEST(RequestCourses, RandomSequencesLoseNoRequestAndDisturbNoOtherCamera) {
    Seen seen;
    for (std::uint32_t seed = 1; seed <= kSeeds && !HasFailure(); ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Course(seed).run(seen);
    }
    for (const int count : seen.pauses)
        EXPECT_GT(count, 20);
    EXPECT_GT(seen.lost, 20);
    EXPECT_GT(seen.failedStarts, 20);
    EXPECT_GT(seen.stopsInRestarts, 20);
}

}  // namespace
}  // namespace mfar
