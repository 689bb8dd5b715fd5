#pragma once

#include "daemon/option_table.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// "0.001 to 10000 ms"; empty for a value without a range.
[[nodiscard]] std::string rangeText(const Option& option);

/// Meaning, the words that the meaning does not mention, and the range, in one paragraph; empty for
/// an option without a meaning of its own.
[[nodiscard]] std::string describe(const Option& option);

/// Breaks text into lines of at most `width` characters; a longer word has a line of its own.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, std::size_t width);

/// The configuration file with all defaults: systemd/mfard.toml.
[[nodiscard]] std::string defaultConfigText();

/// The key of the configuration that a command line option overrides. Throws std::logic_error when
/// there is none.
[[nodiscard]] const Option& overriddenBy(std::string_view argument);

/// The description of a command line option, for --help.
[[nodiscard]] std::string helpFor(std::string_view argument);

/// The words that it takes, "auto, gles, simd".
[[nodiscard]] std::string wordsFor(std::string_view argument);

}  // namespace mfar
