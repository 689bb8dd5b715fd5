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

/// Completion of mfard's command line in bash.
[[nodiscard]] std::string bashCompletion();

/// Keys and sections as a dictionary for libFuzzer, followed by these entries.
[[nodiscard]] std::string fuzzDictionary(std::span<const OptionSection> table,
                                         std::string_view entries);

}  // namespace mfar::test
