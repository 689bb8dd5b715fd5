#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace mfar {

/// One option or positional argument of a program, for the manual page and shell completion.
struct ArgumentText {
    std::string names;  ///< "-h,--help"; without dashes: positional
    std::string value;  ///< "FILE"; empty: a flag
    std::string meaning;
    bool isRequired = false;

    [[nodiscard]] bool isPositional() const { return !names.starts_with('-'); }
};

/// The arguments of a parser, without those of its subcommands. Values, ranges and defaults that
/// the parser knows are in the meaning.
[[nodiscard]] std::vector<ArgumentText> argumentTexts(const CLI::App& app);

}  // namespace mfar
