#pragma once

#include "base/time.h"
#include "hal/camera.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// When a driver gives back all requests that it has not filled, its stream has to be started
/// again. Raspberry Pi's does so after a second without a pulse, which is no fault.
struct RestartLimits {
    /// A stream that ends sooner after its start has ended early.
    std::chrono::milliseconds early{500};
    /// Before the start after the second early end in a row; doubles with each further one.
    std::chrono::milliseconds firstPause{50};
    /// After this many early ends in a row the device counts as lost.
    int most = 5;
};

/// Takes requests by their number and fills them in the order in which it likes.
class RequestDriver {
public:
    virtual ~RequestDriver() = default;
    /// Throws DeviceLost, std::runtime_error.
    virtual void start() = 0;
    /// Returns 0 or a negative error of errno.h. Never waits.
    [[nodiscard]] virtual int queue(std::size_t request) = 0;
    /// Before stop(), while requests may still be completed.
    virtual void prepareStop() = 0;
    /// Completes what is queued. May wait.
    virtual void stop() = 0;
};

/// The requests of a camera, which go round between its driver, which completes them, and those who
/// use the pictures, whose giving back queues them again. Thread-safe; next() is called from one
/// thread, and the driver's start() and stop() are called by next() as well.
class RequestCycle {
public:
    struct Done {
        std::size_t request = 0;
        Timestamp time;
        std::chrono::nanoseconds exposure{0};
    };
    /// Looks at a completed request; nothing: its picture is not to be used.
    using Judge = std::function<std::optional<Done>()>;

    using Clock = std::function<Timestamp()>;

    /// `driver` must outlive this.
    explicit RequestCycle(RequestDriver& driver, const RestartLimits& limits = {},
                          Clock clock = &Timestamp::now);

    /// One more request, before the start. Its number is the count of those before.
    void add();
    /// Queues all requests. Throws what the driver throws.
    void start();
    void stop();
    /// Forgets all requests: those who give one back late do nothing.
    void close();

    /// The oldest picture, which belongs to the caller until it gives it back; nothing when none
    /// comes within `timeout` or after stop(). Throws DeviceLost.
    [[nodiscard]] std::optional<Done> next(std::chrono::milliseconds timeout);
    void giveBack(std::size_t request);

    // For the driver's thread.
    void completed(std::size_t request, const Judge& judge);
    /// A request comes back unfilled.
    void cancelled(std::size_t request);
    /// The device is gone; next() throws.
    void lose(const std::string& why);

    /// Waits until a picture comes, no request is queued or it is stopped; false when nothing of
    /// that happens within this time.
    [[nodiscard]] bool awaitSign(std::chrono::milliseconds within);

    void setName(std::string camera) { name_ = std::move(camera); }
    /// Pictures that were ready to be used.
    [[nodiscard]] std::uint64_t delivered() const;
    /// Times that the driver had given back all requests and was started again.
    [[nodiscard]] std::uint64_t restarts() const;

private:
    enum class State : std::uint8_t { Idle, Queued, Ready, Lent };

    [[nodiscard]] bool anyQueued() const;
    void queue(std::size_t request);
    void queueIdle();
    void loseLocked(const std::string& why);
    void planRestart();
    void begin();
    void halt();
    void restart();

    RequestDriver& driver_;
    const RestartLimits limits_;
    const Clock clock_;
    std::string name_ = "camera";
    std::mutex lifecycle_;  ///< one start() or stop() at a time; taken before the other
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<State> requests_;
    std::deque<Done> ready_;
    bool running_ = false;
    std::string lost_;  ///< why the device is gone; empty: it is not
    Timestamp begun_;
    int earlyEnds_ = 0;  ///< in a row
    std::optional<Timestamp> restartAt_;
    std::uint64_t delivered_ = 0, restarts_ = 0;
};

}  // namespace mfar
