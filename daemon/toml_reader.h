#pragma once

#include "daemon/config_ranges.h"

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

/// Reads typed values from TOML text and collects every fault with its place, so that a file with
/// three mistakes says all three. A key that is asked for is a known key; finish() refuses others.
class TomlReader {
public:
    /// Says what is wrong with a text, nothing when it is good.
    using Check = std::function<std::optional<std::string>(std::string_view)>;

    /// The same for a number that is in its range.
    using NumberCheck = std::function<std::optional<std::string>(double)>;

    using NumbersCheck = std::function<std::optional<std::string>(std::span<const double>)>;

    /// `file` is for messages. Throws ConfigError on broken syntax.
    TomlReader(std::string_view text, std::string file);

    /// Each takes a key "name" or "section.name" and leaves `out` alone when it is absent or wrong.
    void number(std::string_view key, double& out, double least, double most,
                const NumberCheck& check = nullptr);
    void integer(std::string_view key, std::uint64_t& out);
    void integer(std::string_view key, int& out, int least, int most);
    /// The same of a range's own section, or of the one that `prefix` names: "section.".
    void number(const range::ConfigRange& range, double& out, const NumberCheck& check = nullptr,
                std::string_view prefix = {});
    void integer(const range::ConfigRange& range, int& out, std::string_view prefix = {});
    void boolean(std::string_view key, bool& out);
    /// The text is good when `check` says nothing.
    void text(std::string_view key, std::string& out, const Check& check = nullptr);
    /// A list of texts, at least one, each good for `check`.
    void texts(std::string_view key, std::vector<std::string>& out, const Check& check = nullptr);
    /// A list of exactly so many numbers as `out` holds.
    void numbers(std::string_view key, std::span<double> out, double least, double most,
                 const NumbersCheck& check = nullptr);
    void numbers(const range::ConfigRange& range, std::span<double> out,
                 std::string_view prefix = {}, const NumbersCheck& check = nullptr);
    /// A table of texts, numbers and true or false by any name, each as text: "1", "0.5", "true";
    /// in the order of the file.
    void values(std::string_view key, std::vector<std::pair<std::string, std::string>>& out);
    template <class E>
    void choice(std::string_view key, E& out,
                std::span<const std::pair<std::string_view, E>> words);
    /// What stands before the keys of each section [[key]], at most `most` of them: "key[0].".
    [[nodiscard]] std::vector<std::string> sections(std::string_view key, std::size_t most);

    /// Call when all keys have been read. Throws ConfigError with every fault, in file order.
    void finish();

private:
    struct Fault {
        toml::source_position at;
        std::string message;
    };

    const toml::node* find(std::string_view key);
    /// The node when it is of the `wanted` kind; another kind is a fault.
    const toml::node* find(std::string_view key, std::string_view wanted,
                           bool (toml::node::*is)() const);
    void fault(const toml::source_region& at, std::string message);
    void refuseUnknown(const toml::table& table, const std::string& prefix);
    void refuseUnknown(const toml::key& key, const toml::node& value, const std::string& name);

    std::string file_;
    toml::table root_;
    std::vector<std::string> known_;
    std::vector<Fault> faults_;  ///< in file order
};

template <class E>
void TomlReader::choice(std::string_view key, E& out,
                        std::span<const std::pair<std::string_view, E>> words) {
    std::string word;
    text(key, word, [&](std::string_view given) -> std::optional<std::string> {
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
