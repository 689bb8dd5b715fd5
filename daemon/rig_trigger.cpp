#include "daemon/rig_trigger.h"

#include "daemon/exit_code.h"
#include "hal/device/trigger_safe_level.h"

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

void releaseTrigger(const TriggerLineConfig& line) {
    if (line.line.empty()) return;
    orFail(ExitCode::Unavailable, [&] { driveSafe(triggerOptions(line)); });
}

}  // namespace mfar
