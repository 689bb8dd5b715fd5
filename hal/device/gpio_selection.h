#pragma once

#include "hal/device/gpio_lines.h"

#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Finds a line. `chip` is a path, name or label; empty: the only chip with a line of that name.
/// `line` is a number if it consists of digits, otherwise a name. Throws std::runtime_error: chip
/// not found (lists the chips), line not found (lists the named lines), ambiguous, no permission.
[[nodiscard]] GpioAddress findGpioLine(const std::vector<GpioChip>& chips, std::string_view chip,
                                       std::string_view line);

/// Message why a line could not be requested, from the request's errno.
[[nodiscard]] std::string gpioRequestFault(const GpioAddress& line, int error);

/// Paths of the GPIO character devices in `folder`, ordered by number.
[[nodiscard]] std::vector<std::string> gpioChipPaths(const std::string& folder = "/dev");

}  // namespace mfar
