#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace mfar {

struct ArgumentText {
    std::string names;  ///< e.g. "-h,--help"; a positional argument has no dashes
    std::string value;  ///< e.g. "FILE"; empty: the option is a flag
    std::string meaning;
    bool isRequired = false;

    [[nodiscard]] bool isPositional() const { return !names.starts_with('-'); }
};

/// Returns the arguments of a parser, without those of its subcommands. ArgumentText::meaning also
/// contains the valid values, range and default, if they are set in the parser.
[[nodiscard]] std::vector<ArgumentText> argumentTexts(const CLI::App& app);

}  // namespace mfar
