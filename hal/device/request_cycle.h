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

/// Limits for restarts of the stream. The stream must be restarted after a driver has cancelled all
/// queued requests. Raspberry Pi's driver cancels them after a second without a trigger pulse. This
/// is not a fault.
struct RestartLimits {
    /// If the driver cancels all requests within this time after the start, the stream has ended
    /// early.
    std::chrono::milliseconds early{500};
    /// Pause before the restart after two consecutive early ends. It doubles with each further
    /// early end.
    std::chrono::milliseconds firstPause{50};
    int most = 5;  ///< number of consecutive early ends after which the device counts as lost
};

/// A camera driver. It may complete requests in any order. Requests are identified by number.
class RequestDriver {
public:
    virtual ~RequestDriver() = default;
    virtual void start() = 0;
    /// Queues a request. Returns 0 or a negative error number of errno.h. Never waits.
    [[nodiscard]] virtual int queue(std::size_t request) = 0;
    /// Called before stop(), while the driver may still complete requests.
    virtual void prepareStop() = 0;
    virtual void stop() = 0;
};

/// Manages the requests of a camera. Each request goes through a cycle: it is queued, the driver
/// completes it, a user holds its picture and returns it, and it is queued again. Thread-safe, but
/// only one thread may call next(). next() may call the driver's start() and stop(). `driver` must
/// outlive this object.
class RequestCycle {
public:
    struct Done {
        std::size_t request = 0;
        Timestamp time;
        std::chrono::nanoseconds exposure{0};
    };
    /// Checks a completed request. Returns nothing if its picture must not be used.
    using Judge = std::function<std::optional<Done>()>;

    using Clock = std::function<Timestamp()>;

    explicit RequestCycle(RequestDriver& driver, const RestartLimits& limits = {},
                          Clock clock = &Timestamp::now);

    /// Adds a request. Must not be called after start(). Requests are numbered from 0.
    void add();
    void start();
    void stop();
    /// Removes all requests. A request that is returned later is ignored.
    void close();

    /// Returns the oldest picture, which the caller holds until giveBack(). Returns nothing if no
    /// picture comes within `timeout`, if this call restarted the stream, or after stop(). Throws
    /// DeviceLost, and the errors of the driver if it cannot be started again.
    [[nodiscard]] std::optional<Done> next(std::chrono::milliseconds timeout);
    void giveBack(std::size_t request);

    void completed(std::size_t request, const Judge& judge);
    void cancelled(std::size_t request);
    /// Reports that the device is lost. From then on, next() throws.
    void lose(const std::string& why);

    /// Waits until a picture comes, until no request is queued any more, or until stop(). Returns
    /// false if none of these events happens in time.
    [[nodiscard]] bool awaitSign(std::chrono::milliseconds within);

    void setName(std::string camera) { name_ = std::move(camera); }
    [[nodiscard]] std::uint64_t delivered() const;
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
    std::mutex lifecycle_;  ///< allows one start() or stop() at a time; is locked before mutex_
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<State> requests_;
    std::deque<Done> ready_;
    bool running_ = false;
    std::string lost_;
    Timestamp begun_;
    int earlyEnds_ = 0;
    std::optional<Timestamp> restartAt_;
    std::uint64_t delivered_ = 0, restarts_ = 0;
};

}  // namespace mfar
