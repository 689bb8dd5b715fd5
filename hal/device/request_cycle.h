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

/// A driver that cancels all queued requests needs a restart of its stream. Raspberry Pi's driver
/// does this after a second without a trigger pulse, which is not a fault.
struct RestartLimits {
    /// A stream that ends within this time after its start has ended early.
    std::chrono::milliseconds early{500};
    /// Pause before the restart after the second early end in a row; doubles with each further one.
    std::chrono::milliseconds firstPause{50};
    /// After this many early ends in a row the device counts as lost.
    int most = 5;
};

/// Fills requests, identified by number, in any order.
class RequestDriver {
public:
    virtual ~RequestDriver() = default;
    /// Throws DeviceLost, std::runtime_error.
    virtual void start() = 0;
    /// Returns 0 or a negative error of errno.h. Never waits.
    [[nodiscard]] virtual int queue(std::size_t request) = 0;
    /// Called before stop(), while requests may still be completed.
    virtual void prepareStop() = 0;
    /// Completes all queued requests. May wait.
    virtual void stop() = 0;
};

/// Circulates the requests of a camera: the driver completes a request, a user holds its picture,
/// and returning the picture queues the request again. Thread-safe; next() is called from one
/// thread and also calls the driver's start() and stop().
class RequestCycle {
public:
    struct Done {
        std::size_t request = 0;
        Timestamp time;
        std::chrono::nanoseconds exposure{0};
    };
    /// Inspects a completed request; empty: its picture must not be used.
    using Judge = std::function<std::optional<Done>()>;

    using Clock = std::function<Timestamp()>;

    /// `driver` must outlive this.
    explicit RequestCycle(RequestDriver& driver, const RestartLimits& limits = {},
                          Clock clock = &Timestamp::now);

    /// Adds a request, before the start. Requests are numbered from 0.
    void add();
    /// Queues all requests. Throws what the driver throws.
    void start();
    void stop();
    /// Forgets all requests: a request that is returned later is ignored.
    void close();

    /// The oldest picture, which the caller owns until giveBack(); empty when none comes within
    /// `timeout` or after stop(). Throws DeviceLost.
    [[nodiscard]] std::optional<Done> next(std::chrono::milliseconds timeout);
    void giveBack(std::size_t request);

    // Called from the driver's thread.
    void completed(std::size_t request, const Judge& judge);
    /// The driver returns a request unfilled.
    void cancelled(std::size_t request);
    /// Reports that the device is gone; next() throws.
    void lose(const std::string& why);

    /// Waits until a picture comes, no request is queued or the cycle is stopped; false when none
    /// of these happens within this time.
    [[nodiscard]] bool awaitSign(std::chrono::milliseconds within);

    void setName(std::string camera) { name_ = std::move(camera); }
    /// Number of usable pictures.
    [[nodiscard]] std::uint64_t delivered() const;
    /// Number of restarts after the driver had cancelled all requests.
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
    std::mutex lifecycle_;  ///< one start() or stop() at a time; locked before mutex_
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<State> requests_;
    std::deque<Done> ready_;
    bool running_ = false;
    std::string lost_;  ///< why the device is gone; empty: it is not gone
    Timestamp begun_;
    int earlyEnds_ = 0;  ///< early ends in a row
    std::optional<Timestamp> restartAt_;
    std::uint64_t delivered_ = 0, restarts_ = 0;
};

}  // namespace mfar
