#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <time.h>

namespace mfar::pretended {

/// Record of how the program used a simulated camera.
struct KnownOfCamera {
    // Numbers of invalid pictures that the program took.
    std::uint64_t broken = 0;    ///< pictures marked as broken, or too short
    std::uint64_t badTimes = 0;  ///< times in the future, too old, or not after the last valid one
    std::int64_t gain = 0;
    std::uint64_t ungained = 0;  ///< pictures that the program took before it set the gain
};

inline std::int64_t microsecondsNow() {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1'000'000LL + t.tv_nsec / 1000;
}

inline std::int64_t microseconds(const timeval& t) {
    return t.tv_sec * 1'000'000LL + t.tv_usec;
}

/// The records of all cameras, by name. A record is kept when its camera is closed. Thread-safe.
class Known {
public:
    static Known& get() {
        static auto* all = new Known;  // never freed, because threads outlive main()
        return *all;
    }
    [[nodiscard]] KnownOfCamera of(const std::string& camera) {
        const std::lock_guard lock(mutex_);
        return counts_[camera];
    }
    void setGain(const std::string& camera, std::int64_t value) {
        const std::lock_guard lock(mutex_);
        counts_[camera].gain = value;
    }
    /// Counts the picture `taken` in the record of its camera. `whole`: size of a complete picture
    /// [bytes]. `lastGood`: time of the last valid picture since the camera was opened [us,
    /// CLOCK_MONOTONIC]. It is updated if the picture `taken` is valid.
    void add(const std::string& camera, const v4l2_buffer& taken, std::size_t whole,
             std::optional<std::int64_t>& lastGood) {
        constexpr std::int64_t kAhead = 50'000, kOldest = 10'000'000;
        const std::int64_t now = microsecondsNow();
        const std::int64_t stamp = microseconds(taken.timestamp);
        const bool isBad =
            stamp > now + kAhead || stamp < now - kOldest || (lastGood && stamp <= *lastGood);
        const bool isBroken = (taken.flags & V4L2_BUF_FLAG_ERROR) != 0 || taken.bytesused < whole;
        if (!isBad && !isBroken) lastGood = stamp;
        const std::lock_guard lock(mutex_);
        KnownOfCamera& counts = counts_[camera];
        counts.ungained += counts.gain == 0 ? 1 : 0;
        counts.broken += isBroken ? 1 : 0;
        counts.badTimes += isBad && !isBroken ? 1 : 0;
    }

private:
    std::mutex mutex_;
    std::map<std::string, KnownOfCamera> counts_;
};

}  // namespace mfar::pretended
