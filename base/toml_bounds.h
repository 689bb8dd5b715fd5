#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// TOML files are limited, because a parser's recursion and memory grow with the depth and length
/// of a text. kDeepestToml limits nested brackets, and parts of a dotted key. No file of this
/// project reaches these limits.
inline constexpr std::size_t kDeepestToml = 32;
inline constexpr std::size_t kMostTomlValues = 100'000;

/// The position where a text exceeds a limit, and a message. Lines and columns count from 1.
struct TomlExcess {
    std::size_t line, column;
    std::string what;
};

/// Returns the first position where a TOML text exceeds a limit, or nothing. Must be called before
/// the text is parsed. Does not check whether the text is valid TOML.
[[nodiscard]] std::optional<TomlExcess> tomlExcess(std::string_view text);

}  // namespace mfar
