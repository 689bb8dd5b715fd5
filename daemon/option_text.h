#pragma once

#include "daemon/option_table.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Returns e.g. "0.001 to 10000 ms", or an empty text if the option has no range.
[[nodiscard]] std::string rangeText(const Option& option);

/// Describes an option in one paragraph: its meaning, the allowed words unless the meaning mentions
/// all of them, and its range. Returns an empty text if the option has no meaning of its own.
[[nodiscard]] std::string describe(const Option& option);

/// Breaks a text into lines of at most `width` characters. A longer word gets its own line.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, std::size_t width);

[[nodiscard]] std::string defaultConfigText();

/// Returns the configuration key that a command line option overrides. Throws std::logic_error if
/// there is none.
[[nodiscard]] const Option& overriddenBy(std::string_view argument);

[[nodiscard]] std::string helpFor(std::string_view argument);

[[nodiscard]] std::string wordsFor(std::string_view argument);

}  // namespace mfar
