#pragma once

#include "daemon/cameras_config.h"
#include "hal/device/trigger_gpiod.h"
#include "hal/triggered_stills.h"

namespace mfar {

[[nodiscard]] TriggerOptions triggerOptions(const TriggerLineConfig& line);
/// Returns the options of a still camera on this line. The camera does not repeat the pulse of a
/// lost still, because StillPolicy does that.
[[nodiscard]] TriggeredStillOptions stillOptions(const TriggerLineConfig& line);

/// Drives a trigger line to its inactive level. Does nothing if no line is configured. Throws
/// Failure.
void releaseTrigger(const TriggerLineConfig& line);

}  // namespace mfar
