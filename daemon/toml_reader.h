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

/// Reads typed values from a TOML text. Collects all faults with their positions, so that one
/// message reports all faults of a file. A key that was not read before finish() is unknown, which
/// is a fault, too.
class TomlReader {
public:
    /// Returns the fault of a text, or nothing if the text is valid.
    using Check = std::function<std::optional<std::string>(std::string_view)>;

    /// An additional check of a number that is within its range. Returns the fault, or nothing if
    /// the number is valid.
    using NumberCheck = std::function<std::optional<std::string>(double)>;

    using NumbersCheck = std::function<std::optional<std::string>(std::span<const double>)>;

    /// `table` contains the types and ranges of all keys. Reading a key that is not in `table`
    /// throws std::logic_error. `file` names the file in messages. `list` names the command or
    /// document that lists all known keys, for messages. Throws ConfigError if the syntax is
    /// invalid or the text exceeds the limits of toml_bounds.h.
    TomlReader(std::string_view text, std::string file, std::span<const OptionSection> table,
               std::string_view list);

    /// The following functions read the value of a key: "name", "section.name" or, in a list of
    /// sections, "section[0].name". If the value is absent or invalid, `out` is not changed.
    void number(std::string_view key, double& out, const NumberCheck& check = nullptr);
    void integer(std::string_view key, std::uint64_t& out);
    void integer(std::string_view key, int& out);
    /// Reads an integer of at most `most`, which replaces the upper limit in the table of keys.
    void integer(std::string_view key, int& out, int most);
    void boolean(std::string_view key, bool& out);
    void text(std::string_view key, std::string& out, const Check& check = nullptr);
    /// Reads a list of at least one text. `check` checks each text.
    void texts(std::string_view key, std::vector<std::string>& out, const Check& check = nullptr);
    void numbers(std::string_view key, std::span<double> out, const NumbersCheck& check = nullptr);
    /// Reads a table with any keys, whose values are texts, numbers and booleans. Appends the keys
    /// and values to `out`, the values as text: "1", "0.5", "true", in the order of the file.
    void values(std::string_view key, std::vector<std::pair<std::string, std::string>>& out);
    template <class E>
    void choice(std::string_view key, E& out,
                std::span<const std::pair<std::string_view, E>> words);
    /// Returns the prefixes of the keys of all sections [[key]]: "key[0].", "key[1]." and so on.
    /// More than `most` sections are a fault.
    [[nodiscard]] std::vector<std::string> sections(std::string_view key, std::size_t most);

    /// Returns the place of a key as text that begins a message: "file:line:column: key: ". Returns
    /// nothing if the key is absent.
    [[nodiscard]] std::optional<std::string> placeOf(std::string_view key) const;

    /// Must be called after all keys have been read. If there are faults, throws ConfigError with
    /// the faults in the order of the file, at most 50 of them.
    void finish();

private:
    struct Fault {
        toml::source_position at;
        std::string message;
    };

    [[nodiscard]] const Option& option(std::string_view key, OptionType type) const;
    void word(std::string_view key, OptionType type, std::string& out, const Check& check);
    const toml::node* find(std::string_view key);
    /// Returns the node of a key. Adds a fault and returns null if the node's type is not the one
    /// that `wanted` names.
    const toml::node* find(std::string_view key, std::string_view wanted,
                           bool (toml::node::*is)() const);
    void fault(const toml::source_region& at, std::string message);
    void refuseUnknown(const toml::table& table, const std::string& prefix);
    void refuseUnknown(const toml::key& key, const toml::node& value, const std::string& name);
    /// Returns the last part of a message about an unknown key or section: the most similar known
    /// name or, if none is similar, where to find all names.
    [[nodiscard]] std::string suggestion(const std::string& name, bool isSection) const;
    /// Returns true if some key that was looked for starts with `text`.
    [[nodiscard]] bool isPrefix(std::string_view text) const;

    std::string file_;
    std::span<const OptionSection> table_;
    std::string list_;
    toml::table root_;
    std::vector<std::string> known_;
    std::vector<Fault> faults_;
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
