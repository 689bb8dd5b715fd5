#include "daemon/option_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace mfar {
namespace {

constexpr std::size_t kFileWidth = 96, kHelpWidth = 74;

constexpr std::string_view kHead =
    "Configuration of mfard. Every key is optional; the values here are the defaults. \"mfard "
    "--check-config --config FILE\" checks a changed file. Options of the command line override "
    "keys of this file. Paths of files that mfard reads start at this file's folder, paths of what "
    "it writes at its working directory. Changes take effect after a restart. In sections marked "
    "(reload), they also take effect after \"systemctl reload mfard\" or SIGHUP. Sections that are "
    "commented out are absent by default; their values can be examples.";

std::vector<std::string> wordsIn(std::string_view text) {
    std::vector<std::string> out;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        if (end > 0) out.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

std::string comment(std::string_view text) {
    std::string out;
    for (const std::string& line : wrapped(text, kFileWidth))
        out += "# " + line + "\n";
    return out;
}

std::string heading(const OptionSection& section) {
    if (section.name.empty()) return "";
    const bool isList = section.kind == OptionSection::Kind::List;
    std::string about(section.meaning);
    if (section.isReloadable) about += about.empty() ? "(reload)" : " (reload)";
    return fmt::format("{}{}{}{}{}\n", isList ? "[[" : "[", section.name, isList ? "]]" : "]",
                       about.empty() ? "" : "  # ", about);
}

std::string sectionText(const OptionSection& section) {
    std::string out = heading(section);
    bool isFirst = true;
    for (const Option& option : section.options) {
        if (!isFirst && !option.meaning.empty()) out += "\n";
        out += comment(describe(option)) + fmt::format("{} = {}\n", option.name, option.byDefault);
        isFirst = false;
    }
    return out;
}

std::string commented(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        out += end == 0 ? "#\n" : fmt::format("# {}\n", text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    return out;
}

}  // namespace

std::string rangeText(const Option& option) {
    const OptionRange& range = option.range;
    if (range.least == range.most) return "";
    return fmt::format("{} to {}{}{}", range.least, range.most, range.unit.empty() ? "" : " ",
                       range.unit);
}

std::string describe(const Option& option) {
    std::string out(option.meaning);
    if (out.empty()) return out;
    const auto isMentioned = [&](const std::string& word) {
        return out.find('"' + word + '"') != out.npos;
    };
    const std::vector<std::string> words = wordsIn(option.words);
    if (!std::ranges::all_of(words, isMentioned))
        out += fmt::format(" Values: \"{}\".", fmt::join(words, "\", \""));
    if (const std::string range = rangeText(option); !range.empty())
        out += fmt::format(" Range: {}.", range);
    return out;
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
    std::vector<std::string> lines;
    for (const std::string& word : wordsIn(text)) {
        if (lines.empty() || lines.back().size() + 1 + word.size() > width)
            lines.push_back(word);
        else
            lines.back() += ' ' + word;
    }
    return lines;
}

std::string defaultConfigText() {
    std::string out = comment(kHead);
    for (const OptionSection& section : configOptions()) {
        const std::string text = sectionText(section);
        out += "\n" + (section.kind == OptionSection::Kind::Always ? text : commented(text));
    }
    return out;
}

const Option& overriddenBy(std::string_view argument) {
    for (const OptionSection& section : configOptions())
        for (const Option& option : section.options)
            if (option.argument == argument) return option;
    throw std::logic_error(fmt::format("{} overrides no key", argument));
}

std::string helpFor(std::string_view argument) {
    const Option& option = overriddenBy(argument);
    const std::string text = fmt::format("{} Default: {}.", describe(option), option.byDefault);
    return fmt::format("{}", fmt::join(wrapped(text, kHelpWidth), "\n"));
}

std::string wordsFor(std::string_view argument) {
    return fmt::format("{}", fmt::join(wordsIn(overriddenBy(argument).words), ", "));
}

}  // namespace mfar
