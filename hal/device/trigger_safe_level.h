#pragma once

#include "hal/device/trigger_gpiod.h"

namespace mfar {

/// Drives the trigger's line to its inactive level and releases it, for use after a program that
/// ended without doing so (the service's stop hook). Throws std::runtime_error.
void driveSafe(const TriggerOptions& options);

}  // namespace mfar
