#pragma once

#include "daemon/argument_text.h"

#include <string>
#include <string_view>

/// Parts of manual pages in the language of groff's -man.
namespace mfar::test {

/// A paragraph in which groff takes no character as a command.
[[nodiscard]] std::string troff(std::string_view text);

/// The beginning of a page. `source`: the files with the texts of the page.
[[nodiscard]] std::string head(std::string_view name, int section, std::string_view about,
                               std::string_view source);

/// A paragraph with a bold heading.
[[nodiscard]] std::string entry(std::string_view key, std::string_view text);
/// An entry for an argument: its names and value as the heading, and its meaning.
[[nodiscard]] std::string entry(const ArgumentText& argument);

}  // namespace mfar::test
