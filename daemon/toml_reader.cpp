#include "daemon/toml_reader.h"

#include "base/toml_bounds.h"
#include "base/toml_fault.h"
#include "daemon/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace mfar {
namespace {

constexpr std::size_t kMostFaults = 50;
constexpr std::size_t kLongestKey = 200;

bool takeSection(const OptionSection& section, std::string_view& key) {
    if (section.name.empty()) return true;
    if (!key.starts_with(section.name)) return false;
    std::string_view rest = key.substr(section.name.size());
    if (section.kind == OptionSection::Kind::List && rest.starts_with('['))
        rest = rest.substr(std::min(rest.find(']'), rest.size() - 1) + 1);
    if (!rest.starts_with('.')) return false;
    key = rest.substr(1);
    return true;
}

std::string_view kind(const toml::node& node) {
    switch (node.type()) {
    case toml::node_type::table: return "a section";
    case toml::node_type::array: return "a list";
    case toml::node_type::string: return "a text";
    case toml::node_type::integer: return "a whole number";
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "true or false";
    default: return "a date or time";
    }
}

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

std::string_view lastPart(std::string_view key) {
    return key.substr(key.rfind('.') + 1);
}

// Returns how many characters differ between two keys. The last parts of the keys are compared,
// too, because a key may be in a wrong section.
std::size_t distance(std::string_view given, std::string_view known) {
    return std::min(editDistance(given, known), editDistance(lastPart(given), lastPart(known)) + 1);
}

/// Returns the entries of a table in the order of the file. TOML++ itself sorts them by name.
std::vector<std::pair<std::string, const toml::node*>> asWritten(const toml::table& table) {
    std::vector<std::pair<std::string, const toml::node*>> out;
    for (const auto& [name, value] : table)
        out.emplace_back(name.str(), &value);
    std::ranges::sort(out, {}, [](const auto& entry) {
        const toml::source_position& at = entry.second->source().begin;
        return std::pair(at.line, at.column);
    });
    return out;
}

std::string place(const std::string& file, const toml::source_position& at) {
    return fmt::format("{}:{}:{}: ", file, at.line, at.column);
}

// TOML++ does not convert integers above 2^53 to double.
double numberOf(const toml::node& node) {
    const auto whole = node.value_exact<std::int64_t>();
    return whole ? static_cast<double>(*whole) : node.value_exact<double>().value();
}

}  // namespace

TomlReader::TomlReader(std::string_view text, std::string file,
                       std::span<const OptionSection> table, std::string_view list)
    : file_(std::move(file)), table_(table), list_(list) {
    if (const auto excess = tomlExcess(text))
        throw ConfigError(
            fmt::format("{}:{}:{}: {}", file_, excess->line, excess->column, excess->what));
    try {
        root_ = toml::parse(text, file_);
    } catch (const toml::parse_error& error) {
        throw ConfigError(place(file_, error.source().begin) + tomlFault(error.description()));
    }
}

const Option& TomlReader::option(std::string_view key, OptionType type) const {
    for (const OptionSection& section : table_) {
        std::string_view name = key;
        if (!takeSection(section, name)) continue;
        const auto found = std::ranges::find(section.options, name, &Option::name);
        if (found != section.options.end() && found->type == type) return *found;
    }
    throw std::logic_error(fmt::format("no option {} of this type", key));
}

void TomlReader::number(std::string_view key, double& out, const NumberCheck& check) {
    const auto [least, most, unit] = option(key, OptionType::Number).range;
    const toml::node* node = find(key, "a number", &toml::node::is_number);
    if (node == nullptr) return;
    const double value = numberOf(*node);
    if (!(value >= least && value <= most))
        return fault(node->source(),
                     fmt::format("{} must be from {} to {}, not {}", key, least, most, value));
    if (const std::optional<std::string> wrong = check ? check(value) : std::nullopt)
        return fault(node->source(), fmt::format("{} = {}: {}", key, value, *wrong));
    out = value;
}

void TomlReader::integer(std::string_view key, std::uint64_t& out) {
    (void)option(key, OptionType::Whole);
    const toml::node* node = find(key, "a whole number", &toml::node::is_integer);
    if (node == nullptr) return;
    const std::int64_t value = node->value<std::int64_t>().value();
    if (value < 0)
        return fault(node->source(), fmt::format("{} must not be negative: {}", key, value));
    out = static_cast<std::uint64_t>(value);
}

void TomlReader::integer(std::string_view key, int& out) {
    integer(key, out, static_cast<int>(option(key, OptionType::Whole).range.most));
}

void TomlReader::integer(std::string_view key, int& out, int most) {
    const int least = static_cast<int>(option(key, OptionType::Whole).range.least);
    const toml::node* node = find(key, "a whole number", &toml::node::is_integer);
    if (node == nullptr) return;
    const std::int64_t value = node->value<std::int64_t>().value();
    if (value < least || value > most)
        return fault(node->source(),
                     fmt::format("{} must be from {} to {}, not {}", key, least, most, value));
    out = static_cast<int>(value);
}

void TomlReader::boolean(std::string_view key, bool& out) {
    (void)option(key, OptionType::Flag);
    const toml::node* node = find(key, "true or false", &toml::node::is_boolean);
    if (node == nullptr) return;
    out = node->value<bool>().value();
}

void TomlReader::text(std::string_view key, std::string& out, const Check& check) {
    word(key, OptionType::Text, out, check);
}

void TomlReader::word(std::string_view key, OptionType type, std::string& out, const Check& check) {
    (void)option(key, type);
    const toml::node* node = find(key, "a text in quotes", &toml::node::is_string);
    if (node == nullptr) return;
    std::string value = node->value<std::string>().value();
    if (const std::optional<std::string> wrong = check ? check(value) : std::nullopt)
        return fault(node->source(), fmt::format("{} = \"{}\": {}", key, value, *wrong));
    out = std::move(value);
}

void TomlReader::texts(std::string_view key, std::vector<std::string>& out, const Check& check) {
    (void)option(key, OptionType::Texts);
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const toml::array* list = node->as_array();
    if (list == nullptr || list->empty())
        return fault(node->source(), fmt::format("{} must be a list of texts in quotes, not {}",
                                                 key, list ? "an empty one" : kind(*node)));
    std::vector<std::string> values;
    for (const toml::node& element : *list) {
        if (!element.is_string())
            return fault(element.source(),
                         fmt::format("{} must be a list of texts in quotes, but contains {}", key,
                                     kind(element)));
        std::string value = element.value<std::string>().value();
        if (const std::optional<std::string> wrong = check ? check(value) : std::nullopt)
            return fault(element.source(), fmt::format("{} \"{}\": {}", key, value, *wrong));
        values.push_back(std::move(value));
    }
    out = std::move(values);
}

void TomlReader::numbers(std::string_view key, std::span<double> out, const NumbersCheck& check) {
    const auto [least, most, unit] = option(key, OptionType::Numbers).range;
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const toml::array* list = node->as_array();
    if (list == nullptr || list->size() != out.size())
        return fault(node->source(),
                     fmt::format("{} must be a list of {} numbers", key, out.size()));
    std::vector<double> values;
    for (const toml::node& element : *list) {
        const double value = element.is_number() ? numberOf(element) : NAN;
        if (!(value >= least && value <= most))
            return fault(element.source(),
                         fmt::format("{} must hold numbers from {} to {}", key, least, most));
        values.push_back(value);
    }
    if (const std::optional<std::string> wrong = check ? check(values) : std::nullopt)
        return fault(node->source(), fmt::format("{}: {}", key, *wrong));
    std::copy(values.begin(), values.end(), out.begin());
}

void TomlReader::values(std::string_view key,
                        std::vector<std::pair<std::string, std::string>>& out) {
    (void)option(key, OptionType::Values);
    const toml::node* node = find(key, "a section", &toml::node::is_table);
    if (node == nullptr) return;
    for (const auto& [name, entry] : asWritten(*node->as_table())) {
        const toml::node& value = *entry;
        const std::string full = fmt::format("{}.{}", key, name);
        std::string& text = out.emplace_back(name, "").second;
        if (const auto flag = value.value_exact<bool>())
            text = *flag ? "true" : "false";
        else if (const auto whole = value.value_exact<std::int64_t>())
            text = fmt::format("{}", *whole);
        else if (const auto number = value.value_exact<double>(); number && std::isfinite(*number))
            text = fmt::format("{}", *number);
        else if (const auto word = value.value_exact<std::string>())
            text = *word;
        else
            fault(value.source(),
                  fmt::format("{} must be a number, a text in quotes, true or false", full));
    }
}

std::vector<std::string> TomlReader::sections(std::string_view key, std::size_t most) {
    std::vector<std::string> out;
    const toml::node* node = find(key);
    if (node == nullptr) return out;
    const toml::array* list = node->as_array();
    if (list == nullptr || !list->is_homogeneous(toml::node_type::table)) {
        fault(node->source(), fmt::format("{} must be written as sections [[{}]]", key, key));
        return out;
    }
    if (list->size() > most) {
        fault(node->source(), fmt::format("found {} sections [[{}]]; at most {} are allowed",
                                          list->size(), key, most));
        return out;
    }
    for (std::size_t i = 0; i < list->size(); ++i)
        out.push_back(fmt::format("{}[{}].", key, i));
    return out;
}

std::optional<std::string> TomlReader::placeOf(std::string_view key) const {
    const toml::node* node = root_.at_path(key).node();
    if (node == nullptr) return std::nullopt;
    return fmt::format("{}{}: ", place(file_, node->source().begin), key);
}

void TomlReader::finish() {
    refuseUnknown(root_, "");
    if (faults_.empty()) return;
    if (faults_.size() == kMostFaults)
        faults_.push_back({faults_.back().at, "more faults may follow"});
    std::string all;
    for (const Fault& one : faults_)
        all += (all.empty() ? "" : "\n") + place(file_, one.at) + one.message;
    throw ConfigError(all);
}

const toml::node* TomlReader::find(std::string_view key) {
    known_.emplace_back(key);
    return root_.at_path(key).node();
}

const toml::node* TomlReader::find(std::string_view key, std::string_view wanted,
                                   bool (toml::node::*is)() const) {
    const toml::node* node = find(key);
    if (node == nullptr || (node->*is)()) return node;
    fault(node->source(), fmt::format("{} must be {}, not {}", key, wanted, kind(*node)));
    return nullptr;
}

void TomlReader::fault(const toml::source_region& at, std::string message) {
    if (faults_.size() == kMostFaults) return;
    const auto later = std::upper_bound(
        faults_.begin(), faults_.end(), at.begin,
        [](const toml::source_position& x, const Fault& other) { return x < other.at; });
    faults_.insert(later, {at.begin, std::move(message)});
}

void TomlReader::refuseUnknown(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, value] : table) {
        const std::string_view name = key.str();
        // A name that contains a dot or bracket was written in quotes. Then it is a single key:
        // "a.b" is not the key b of section a.
        if (name.find_first_of(".[]") != name.npos && name.size() <= kLongestKey)
            fault(key.source(),
                  fmt::format("unknown key \"{}\"; write names without quotes", name));
        else
            refuseUnknown(key, value, prefix + std::string(name));
    }
}

bool TomlReader::isPrefix(std::string_view text) const {
    return std::ranges::any_of(known_,
                               [&](const std::string& known) { return known.starts_with(text); });
}

void TomlReader::refuseUnknown(const toml::key& key, const toml::node& value,
                               const std::string& name) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) {
        // If the section is a list, the keys of each entry are checked. If no key of an entry was
        // looked for, sections() has refused the whole list.
        if (const toml::array* list = value.as_array())
            for (std::size_t i = 0; i < list->size(); ++i) {
                const toml::table* section = (*list)[i].as_table();
                const std::string prefix = fmt::format("{}[{}].", name, i);
                if (section != nullptr && isPrefix(prefix)) refuseUnknown(*section, prefix);
            }
        return;
    }
    const bool isSection = isPrefix(name + ".");
    if (isSection && value.is_table()) return refuseUnknown(*value.as_table(), name + ".");
    if (isSection)
        return fault(key.source(),
                     fmt::format("{} must be a section [{}], not {}", name, name, kind(value)));
    if (name.size() > kLongestKey)
        return fault(key.source(), fmt::format("unknown key of {} characters", name.size()));
    if (faults_.size() == kMostFaults) return;
    fault(key.source(), (value.is_table() ? fmt::format("unknown section [{}]", name)
                                          : fmt::format("unknown key {}", name)) +
                            suggestion(name, value.is_table()));
}

std::string TomlReader::suggestion(const std::string& name, bool isSection) const {
    std::string nearest;
    std::size_t least = lastPart(name).size() / 2 + 1;
    const auto offer = [&](const std::string& known) {
        const std::size_t changes = distance(name, known);
        if (changes >= least) return;
        least = changes;
        nearest = known;
    };
    for (const std::string& known : known_) {
        if (!isSection) offer(known);
        for (std::size_t dot = known.find('.'); isSection && dot != std::string::npos;
             dot = known.find('.', dot + 1))
            offer(known.substr(0, dot));
    }
    if (nearest.empty()) return fmt::format("; {} lists all known ones", list_);
    return fmt::format("; the nearest known one is {}", isSection ? "[" + nearest + "]" : nearest);
}

}  // namespace mfar
