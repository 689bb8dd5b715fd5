#pragma once

#include "daemon/option_table.h"

#include <span>
#include <string>
#include <string_view>

namespace mfar::test {

/// The text of docs/configuration.md.
[[nodiscard]] std::string configurationPage();

/// Manual pages in the language of groff's -man.
[[nodiscard]] std::string programManPage();
[[nodiscard]] std::string configManPage();
/// The manual pages of mfarctl, mfar-sim and mfar-calibrate, from their parsers.
[[nodiscard]] std::string controlManPage();
[[nodiscard]] std::string simManPage();
[[nodiscard]] std::string calibrateManPage();

/// Completion of mfard's command line in bash.
[[nodiscard]] std::string bashCompletion();

/// Keys and sections as a dictionary for libFuzzer, followed by the lines of `entries`.
[[nodiscard]] std::string fuzzDictionary(std::span<const OptionSection> table,
                                         std::string_view entries);

}  // namespace mfar::test
