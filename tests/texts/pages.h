#pragma once

#include <string>

namespace mfar::test {

/// docs/configuration.md.
[[nodiscard]] std::string configurationPage();

/// Manual pages in the language of groff's -man.
[[nodiscard]] std::string programManPage();
[[nodiscard]] std::string configManPage();

/// Completion of mfard's command line in bash.
[[nodiscard]] std::string bashCompletion();

}  // namespace mfar::test
