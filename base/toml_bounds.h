#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Limits that no file of this project exceeds. A parser's recursion and memory grow with the depth
/// and length of its text.
inline constexpr std::size_t kDeepestToml = 32;  ///< nested brackets, or parts of a key
inline constexpr std::size_t kMostTomlValues = 100'000;

/// A place in a text, counted from 1, and the fault there.
struct TomlExcess {
    std::size_t line, column;
    std::string what;
};

/// The first place at which a TOML text exceeds the limits; empty when it does not. To be called
/// before parsing. Does not check whether the text is valid TOML.
[[nodiscard]] std::optional<TomlExcess> tomlExcess(std::string_view text);

}  // namespace mfar
