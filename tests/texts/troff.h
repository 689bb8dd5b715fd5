#pragma once

#include "daemon/argument_text.h"

#include <string>
#include <string_view>

namespace mfar::test {

[[nodiscard]] std::string troff(std::string_view text);

/// The beginning of a page. `source`: the files that contain the page's texts.
[[nodiscard]] std::string head(std::string_view name, int section, std::string_view about,
                               std::string_view source);

[[nodiscard]] std::string entry(std::string_view key, std::string_view text);
[[nodiscard]] std::string entry(const ArgumentText& argument);

}  // namespace mfar::test
