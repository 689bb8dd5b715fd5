#pragma once

#include "daemon/argument_text.h"

#include <string>
#include <string_view>

/// Parts of manual pages in the language of groff's -man.
namespace mfar::test {

/// A paragraph, so that no character of it is a command of groff.
[[nodiscard]] std::string troff(std::string_view text);

/// The begin of a page. `source`: the files that it is printed from.
[[nodiscard]] std::string head(std::string_view name, int section, std::string_view about,
                               std::string_view source);

/// A paragraph with a bold heading.
[[nodiscard]] std::string entry(std::string_view key, std::string_view text);
[[nodiscard]] std::string entry(const ArgumentText& argument);

}  // namespace mfar::test
