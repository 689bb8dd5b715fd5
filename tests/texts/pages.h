#pragma once

#include "daemon/option_table.h"

#include <span>
#include <string>
#include <string_view>

namespace mfar::test {

[[nodiscard]] std::string configurationPage();

[[nodiscard]] std::string programManPage();
[[nodiscard]] std::string configManPage();
/// The manual pages of mfarctl, mfar-sim and mfar-calibrate, from their parsers.
[[nodiscard]] std::string controlManPage();
[[nodiscard]] std::string simManPage();
[[nodiscard]] std::string calibrateManPage();

[[nodiscard]] std::string bashCompletion();

/// Keys and sections as a dictionary for libFuzzer, followed by the lines of `entries`.
[[nodiscard]] std::string fuzzDictionary(std::span<const OptionSection> table,
                                         std::string_view entries);

}  // namespace mfar::test
