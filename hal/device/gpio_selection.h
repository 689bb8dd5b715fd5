#pragma once

#include "hal/device/gpio_lines.h"

#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Finds a line. `chip` is a path, name or label; empty: the only chip with a line of that name.
/// `line` is a number, when it consists of digits, or a name. Throws std::runtime_error: no such
/// chip (lists the chips), no such line (lists the named lines), more than one, no permission.
[[nodiscard]] GpioAddress findGpioLine(const std::vector<GpioChip>& chips, std::string_view chip,
                                       std::string_view line);

/// Why a line could not be taken, from the errno of the request.
[[nodiscard]] std::string gpioRequestFault(const GpioAddress& line, int error);

/// Paths of the GPIO character devices in `folder`, by number.
[[nodiscard]] std::vector<std::string> gpioChipPaths(const std::string& folder = "/dev");

}  // namespace mfar
