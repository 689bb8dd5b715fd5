#pragma once

#include "daemon/cameras_config.h"
#include "hal/device/trigger_gpiod.h"

namespace mfar {

[[nodiscard]] TriggerOptions triggerOptions(const TriggerLineConfig& line);

/// Drives a trigger line to its inactive level. Does nothing if no line is configured. Throws
/// Failure.
void releaseTrigger(const TriggerLineConfig& line);

}  // namespace mfar
