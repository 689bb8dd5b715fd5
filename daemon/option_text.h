#pragma once

#include "daemon/option_table.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// "0.001 to 10000 ms"; empty for a value without range.
[[nodiscard]] std::string rangeText(const Option& option);

/// Meaning, the words that the meaning does not mention, and range, in one paragraph; empty for an
/// option without a meaning of its own.
[[nodiscard]] std::string describe(const Option& option);

/// Lines of at most `width` characters; a longer word has a line of its own.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, std::size_t width);

/// The configuration file with all defaults: systemd/mfard.toml.
[[nodiscard]] std::string defaultConfigText();

/// The key of the configuration that an option of the command line overrides. Throws
/// std::logic_error when there is none.
[[nodiscard]] const Option& overriddenBy(std::string_view argument);

/// Its description for --help.
[[nodiscard]] std::string helpFor(std::string_view argument);

/// Its words, "auto, gles, simd".
[[nodiscard]] std::string wordsFor(std::string_view argument);

}  // namespace mfar
