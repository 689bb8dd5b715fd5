#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// More than any file of ours has. A parser recurses and takes memory as deep and as long as its
/// text goes on.
inline constexpr std::size_t kDeepestToml = 32;  ///< brackets in brackets, parts of a key
inline constexpr std::size_t kMostTomlValues = 100'000;

/// A place in a text, counted from 1, and what is wrong there.
struct TomlExcess {
    std::size_t line, column;
    std::string what;
};

/// The first place at which a TOML text goes beyond these bounds; nothing when it does not. To be
/// called before the text is parsed. Whether it is TOML at all is the parser's to say.
[[nodiscard]] std::optional<TomlExcess> tomlExcess(std::string_view text);

}  // namespace mfar
