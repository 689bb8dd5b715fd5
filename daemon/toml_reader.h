#pragma once

#include "daemon/option_table.h"

#include <toml++/toml.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mfar {

/// Reads typed values from TOML text and collects every fault with its place, so that all faults of
/// a file are reported at once. Keys that have been read are known; finish() refuses all others.
class TomlReader {
public:
    /// Returns the fault of a text, nothing for a valid one.
    using Check = std::function<std::optional<std::string>(std::string_view)>;

    /// The same for a number within its range.
    using NumberCheck = std::function<std::optional<std::string>(double)>;

    using NumbersCheck = std::function<std::optional<std::string>(std::span<const double>)>;

    /// `table` has the types and ranges of all keys that may be read; reading another key throws
    /// std::logic_error. `file` is for messages. Throws ConfigError on invalid syntax.
    TomlReader(std::string_view text, std::string file, std::span<const OptionSection> table);

    /// Each takes a key "name", "section.name" or, in a list of sections, "section[0].name", and
    /// leaves `out` unchanged when it is absent or invalid.
    void number(std::string_view key, double& out, const NumberCheck& check = nullptr);
    void integer(std::string_view key, std::uint64_t& out);
    void integer(std::string_view key, int& out);
    /// As above, with an upper limit lower than the table's.
    void integer(std::string_view key, int& out, int most);
    void boolean(std::string_view key, bool& out);
    /// The text is valid when `check` returns nothing.
    void text(std::string_view key, std::string& out, const Check& check = nullptr);
    /// A list of at least one text, each checked by `check`.
    void texts(std::string_view key, std::vector<std::string>& out, const Check& check = nullptr);
    /// A list of exactly as many numbers as `out` has.
    void numbers(std::string_view key, std::span<double> out, const NumbersCheck& check = nullptr);
    /// A table with any keys and texts, numbers and booleans as values, each returned as text: "1",
    /// "0.5", "true"; in the order of the file.
    void values(std::string_view key, std::vector<std::pair<std::string, std::string>>& out);
    template <class E>
    void choice(std::string_view key, E& out,
                std::span<const std::pair<std::string_view, E>> words);
    /// The prefixes of the keys in each section [[key]], "key[0].". More than `most` sections are a
    /// fault.
    [[nodiscard]] std::vector<std::string> sections(std::string_view key, std::size_t most);

    /// Call when all keys have been read. Throws ConfigError with every fault, in file order.
    void finish();

private:
    struct Fault {
        toml::source_position at;
        std::string message;
    };

    /// The table's entry of this key. Throws std::logic_error when there is none of this type.
    [[nodiscard]] const Option& option(std::string_view key, OptionType type) const;
    void word(std::string_view key, OptionType type, std::string& out, const Check& check);
    const toml::node* find(std::string_view key);
    /// The node if it is of the `wanted` kind; another kind is a fault.
    const toml::node* find(std::string_view key, std::string_view wanted,
                           bool (toml::node::*is)() const);
    void fault(const toml::source_region& at, std::string message);
    void refuseUnknown(const toml::table& table, const std::string& prefix);
    void refuseUnknown(const toml::key& key, const toml::node& value, const std::string& name);

    std::string file_;
    std::span<const OptionSection> table_;
    toml::table root_;
    std::vector<std::string> known_;
    std::vector<Fault> faults_;  ///< in file order
};

template <class E>
void TomlReader::choice(std::string_view key, E& out,
                        std::span<const std::pair<std::string_view, E>> words) {
    std::string word;
    this->word(key, OptionType::Word, word,
               [&](std::string_view given) -> std::optional<std::string> {
                   std::string list;
                   for (const auto& [name, value] : words) {
                       if (name == given) {
                           out = value;
                           return std::nullopt;
                       }
                       list.append(list.empty() ? "\"" : ", \"").append(name).append("\"");
                   }
                   return "must be one of " + list;
               });
}

}  // namespace mfar
