#include "daemon/argument_text.h"

#include <CLI/CLI.hpp>

namespace mfar {
namespace {

std::string between(const std::string& text, char open, char close) {
    const std::size_t begin = text.find(open), end = text.rfind(close);
    if (begin == text.npos || end == text.npos || end < begin) return "";
    return text.substr(begin + 1, end - begin - 1);
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += with.size())
        text.replace(at, what.size(), with);
    return text;
}

/// Appends the valid values and the default to the meaning of an option. `checks` is CLI11's
/// description of the valid values: "{one,two}" for a set, "FLOAT in [0 - 2]" for a range.
std::string withChecks(std::string meaning, const std::string& checks,
                       const std::string& byDefault) {
    const auto add = [&](const char* what, const std::string& text) {
        if (text.empty()) return;
        if (!meaning.ends_with('.')) meaning += '.';
        meaning += std::string(" ") + what + ": " + text + ".";
    };
    add("Values", replaced(between(checks, '{', '}'), ",", ", "));
    add("Range", replaced(between(checks, '[', ']'), " - ", " to "));
    add("Default", byDefault);
    return meaning;
}

}  // namespace

std::vector<ArgumentText> argumentTexts(const CLI::App& app) {
    std::vector<ArgumentText> out;
    for (const CLI::Option* option : app.get_options()) {
        const bool isFlag = option->get_items_expected_max() == 0;
        const std::string type = option->get_type_name();
        const std::size_t colon = std::min(type.find(':'), type.size());
        out.push_back(
            {option->get_name(false, true), isFlag ? "" : type.substr(0, colon),
             withChecks(option->get_description(), type.substr(colon), option->get_default_str()),
             option->get_required()});
    }
    return out;
}

}  // namespace mfar
