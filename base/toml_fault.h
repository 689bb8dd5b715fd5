#pragma once

#include <string>
#include <string_view>

namespace mfar {

/// Returns the description of a toml::parse_error in words that name a missing quote. TOML++ itself
/// reports only where the text must end: at a line break, which is a control character, or at the
/// end of the file.
[[nodiscard]] inline std::string tomlFault(std::string_view description) {
    const bool isText = description.starts_with("Error while parsing string") ||
                        description.starts_with("Error while parsing literal string");
    if (isText && description.find("control characters") != description.npos)
        return "the closing quote of a text is missing, or the text has a control character";
    if (isText && description.find("end-of-file") != description.npos)
        return "the closing quote of a text is missing";
    return std::string(description);
}

}  // namespace mfar
