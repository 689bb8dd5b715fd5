#pragma once

#include <span>
#include <string_view>

namespace mfar {

enum class OptionType : unsigned char {
    Text,
    Word,
    Texts,  ///< a list of texts; if Option::words is set, only these words
    Flag,
    Whole,
    Number,
    Numbers,
    Values,  ///< a table with any keys; its values are texts, numbers and flags
};

/// The smallest and the largest valid number. If both are equal, any number is valid.
struct OptionRange {
    double least = 0, most = 0;
    std::string_view unit{};
};

struct Option {
    std::string_view name{};
    OptionType type = OptionType::Text;
    std::string_view byDefault{};  ///< TOML text of the default; if isAbsent is set, an example
    std::string_view meaning{};    ///< sentences; empty: same meaning as in the previous section
    std::string_view words{};      ///< the allowed words, separated by spaces
    OptionRange range{};
    int count = 1;
    std::string_view argument{};  ///< the command line option of mfard that overrides the key
    bool isAbsent = false;  ///< true: absent by default; `meaning` says what an absent key means
};

struct OptionSection {
    enum class Kind : unsigned char {
        Always,
        Absent,
        List,  ///< [[name]]: may occur several times
    };

    std::string_view name{};  ///< e.g. "cameras.video"; empty: the keys before all sections
    std::span<const Option> options{};
    std::string_view meaning{};
    bool isReloadable = false;
    Kind kind = Kind::Always;
};

/// Returns all keys of mfard's configuration. The parser takes types and ranges from this table.
/// mfar-texts prints mfard.toml, the manual pages and docs/configuration.md from it.
[[nodiscard]] std::span<const OptionSection> configOptions();

/// Returns the keys of the governor's table of levels (`table` in section [governor]).
[[nodiscard]] std::span<const OptionSection> levelOptions();

}  // namespace mfar
