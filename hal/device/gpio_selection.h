#pragma once

#include "hal/device/gpio_lines.h"

#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Finds a GPIO line. `chip` is the path, name or label of a chip; if it is empty, all chips are
/// searched. `line` is a number if it consists of digits, otherwise a name. A number needs `chip`.
/// Throws std::runtime_error if no line or several lines match, or if the process has no
/// permission.
[[nodiscard]] GpioAddress findGpioLine(const std::vector<GpioChip>& chips, std::string_view chip,
                                       std::string_view line);

[[nodiscard]] std::string gpioRequestFault(const GpioAddress& line, int error);

[[nodiscard]] std::vector<std::string> gpioChipPaths(const std::string& folder = "/dev");

}  // namespace mfar
