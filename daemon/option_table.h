#pragma once

#include <span>
#include <string_view>

namespace mfar {

/// The type of a value in TOML.
enum class OptionType : unsigned char {
    Text,
    Word,     ///< a text that is one of Option::words
    Texts,    ///< a list of texts; if Option::words is set, a list of these
    Flag,     ///< true or false
    Whole,    ///< a whole number
    Number,   ///< any number
    Numbers,  ///< a list of Option::count numbers
    Values,   ///< a table with any keys, whose values are texts, numbers and flags
};

/// The smallest and the largest valid number. If both are equal, any number is valid.
struct OptionRange {
    double least = 0, most = 0;
    std::string_view unit{};  ///< empty: the number has no unit
};

/// A key of a configuration file.
struct Option {
    std::string_view name{};
    OptionType type = OptionType::Text;
    std::string_view byDefault{};  ///< default as TOML text; if isAbsent is set, an example
    std::string_view meaning{};    ///< sentences; empty: same meaning as in the previous section
    std::string_view words{};      ///< the allowed words, separated by spaces
    OptionRange range{};           ///< valid range of the number, or of each number in a list
    int count = 1;                 ///< number of elements of a list
    std::string_view argument{};   ///< the command line option of mfard that overrides the key
    bool isAbsent = false;  ///< whether the key is absent by default, with a meaning of its own
};

struct OptionSection {
    enum class Kind : unsigned char {
        Always,
        Absent,  ///< the section is absent by default
        List,    ///< the section is [[name]] and may occur several times
    };

    std::string_view name{};  ///< e.g. "cameras.video"; empty: the keys before all sections
    std::span<const Option> options{};
    std::string_view meaning{};
    bool isReloadable = false;  ///< changes take effect without a restart
    Kind kind = Kind::Always;
};

/// Returns all keys of mfard's configuration. The parser takes types and ranges from this table,
/// and mfard.toml, the manual pages and docs/configuration.md are printed from it.
[[nodiscard]] std::span<const OptionSection> configOptions();

/// Returns the keys of a table of levels for the governor (`table` in section [governor]).
[[nodiscard]] std::span<const OptionSection> levelOptions();

}  // namespace mfar
