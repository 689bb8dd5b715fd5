#include "hal/device/picture_times.h"

namespace mfar {

bool PictureTimes::isSound(const Reported& picture) {
    if (picture.isStartup) {
        ++counters_.startup;
        return false;
    }
    const bool sound = !picture.failed && picture.bytes >= leastBytes_;
    if (!sound) ++counters_.broken;
    return sound;
}

std::optional<Timestamp> PictureTimes::add(const Reported& picture,
                                           const SensorClock::Now& arrived) {
    if (!isSound(picture)) {
        drops_.addUntimed(picture.sequence);
        return std::nullopt;
    }
    const bool timed = picture.stamp != 0;
    std::optional<Timestamp> time = arrived.monotonic;
    if (timed) time = clock_.toMonotonic({picture.stamp}, arrived);
    if (timed && time) time = *time + picture.exposure / 2;
    if (!time || (last_ && *time <= *last_)) {
        ++counters_.badTimes;
        drops_.addUntimed(picture.sequence);
        return std::nullopt;
    }
    if (!timed) ++counters_.untimed;
    if (timed && rateHz_ > 0)
        drops_.add(*time, picture.sequence);
    else
        drops_.addUntimed(picture.sequence);
    last_ = time;
    return time;
}

}  // namespace mfar
