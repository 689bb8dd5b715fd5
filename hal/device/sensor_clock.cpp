#include "hal/device/sensor_clock.h"

#include <chrono>
#include <ctime>

namespace mfar {
namespace {

constexpr int kCompared = 8;
constexpr std::chrono::nanoseconds kOldest = std::chrono::seconds(10);

bool isPast(Timestamp stamp, Timestamp now) {
    return stamp <= now && stamp >= now - kOldest;
}

}  // namespace

SensorClock::Now SensorClock::Now::read() {
    timespec t{};
    clock_gettime(CLOCK_BOOTTIME, &t);
    return {Timestamp::now(), {static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec}};
}

std::optional<Timestamp> SensorClock::toMonotonic(Timestamp stamp, const Now& now) {
    if (compared_ < kCompared) {
        ++compared_;
        if (stamp > now.monotonic && isPast(stamp, now.boottime)) kind_ = Kind::Boottime;
    }
    const bool monotonic = kind_ == Kind::Monotonic;
    if (!isPast(stamp, monotonic ? now.monotonic : now.boottime)) return std::nullopt;
    return monotonic ? stamp : stamp - (now.boottime - now.monotonic);
}

}  // namespace mfar
