#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Limits of a TOML text. Without them, the recursion and memory of the parser would grow with the
/// text. kDeepestToml limits the depth of nested brackets, and the number of parts of a key.
/// kMostTomlValues limits the number of the characters , = [ { and . outside of strings and
/// comments. No file of this project reaches these limits.
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
