#pragma once

#include <span>
#include <string_view>

namespace mfar {

/// Type of a value in TOML.
enum class OptionType : unsigned char {
    Text,
    Word,     ///< a text, one of Option::words
    Texts,    ///< a list of texts; of Option::words when there are any
    Flag,     ///< true or false
    Whole,    ///< a whole number
    Number,   ///< any number
    Numbers,  ///< a list of Option::count numbers
    Values,   ///< a table of texts, numbers and flags by any name
};

/// The lower and upper limit of a number, both included; equal: no limits.
struct OptionRange {
    double least = 0, most = 0;
    std::string_view unit{};  ///< empty: no unit
};

/// A key of a configuration file.
struct Option {
    std::string_view name{};
    OptionType type = OptionType::Text;
    std::string_view byDefault{};  ///< as in TOML; for an absent key, an example
    std::string_view meaning{};    ///< sentences; empty: as in the previous section
    std::string_view words{};      ///< separated by spaces
    OptionRange range{};           ///< for each number
    int count = 1;                 ///< number of elements of a list
    std::string_view argument{};   ///< the option of mfard's command line that overrides it
    bool isAbsent = false;         ///< absent by default, which has a meaning of its own
};

struct OptionSection {
    enum class Kind : unsigned char {
        Always,
        Absent,  ///< absent by default
        List,    ///< [[name]], any number of them
    };

    std::string_view name{};  ///< "cameras.video"; empty: the keys before all sections
    std::span<const Option> options{};
    std::string_view meaning{};
    bool isReloadable = false;  ///< changes take effect without a restart
    Kind kind = Kind::Always;
};

/// mfard's configuration. The parser takes types and ranges from here; mfard.toml, the manual pages
/// and docs/configuration.md are printed from it.
[[nodiscard]] std::span<const OptionSection> configOptions();

/// A table of levels for the governor (`table` in section [governor]).
[[nodiscard]] std::span<const OptionSection> levelOptions();

}  // namespace mfar
