#include "daemon/rig_trigger.h"

#include "daemon/exit_code.h"
#include "hal/device/trigger_safe_level.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mfar {

TriggerOptions triggerOptions(const TriggerLineConfig& line) {
    TriggerOptions out;
    out.chip = line.chip;
    out.line = line.line;
    out.activeLow = line.activeLow;
    out.pulse = std::chrono::microseconds(std::llround(line.pulseMs * 1e3));
    out.loopbackChip = line.loopbackChip;
    out.loopback = line.loopback;
    return out;
}

TriggeredStillOptions stillOptions(const TriggerLineConfig& line) {
    const auto nanoseconds = [](double ms) {
        return std::chrono::nanoseconds(std::llround(ms * 1e6));
    };
    TriggeredStillOptions out;
    if (line.pulseIsExposure) out.exposure = nanoseconds(line.pulseMs);
    StillMatcherOptions& matching = out.matching;
    matching.guess = nanoseconds(line.delayMs);
    matching.window = nanoseconds(line.jitterMs);
    matching.wideWindow = std::max(matching.wideWindow, matching.window);
    // The matcher counts from the start of the exposure.
    matching.timeout = nanoseconds(line.arrivalMs) + out.exposure;
    matching.repeat = false;
    return out;
}

void releaseTrigger(const TriggerLineConfig& line) {
    if (line.line.empty()) return;
    orFail(ExitCode::Unavailable, [&] { driveSafe(triggerOptions(line)); });
}

}  // namespace mfar
