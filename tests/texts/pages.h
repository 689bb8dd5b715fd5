#pragma once

#include "daemon/argument_text.h"
#include "daemon/option_table.h"

#include <span>
#include <string>
#include <string_view>

namespace mfar::test {

[[nodiscard]] std::string configurationPage();

[[nodiscard]] std::string programManPage();
[[nodiscard]] std::string configManPage();
/// The manual pages of mfarctl, mfar-sim, mfar-calibrate and mfar-print, from their parsers.
[[nodiscard]] std::string controlManPage();
[[nodiscard]] std::string simManPage();
[[nodiscard]] std::string calibrateManPage();
[[nodiscard]] std::string printManPage();

/// Completions of mfard's and mfarctl's command lines in bash, from their parsers.
[[nodiscard]] std::string bashCompletion();
[[nodiscard]] std::string controlCompletion();

/// Returns the last of the names of an option, e.g. "--help" of "-h,--help".
[[nodiscard]] std::string longName(const ArgumentText& argument);

/// Keys and sections as a dictionary for libFuzzer, followed by the lines of `entries`.
[[nodiscard]] std::string fuzzDictionary(std::span<const OptionSection> table,
                                         std::string_view entries);

}  // namespace mfar::test
