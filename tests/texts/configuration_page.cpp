#include "daemon/option_text.h"
#include "tests/texts/pages.h"

#include <fmt/format.h>

namespace mfar::test {
namespace {

constexpr std::string_view kIntroduction =
    R"(# Configuration

<!-- Printed from daemon/option_table.cpp by mfar-texts; edit the table. -->

`mfard --config FILE` reads a TOML file; the service reads `/etc/mfar/mfard.toml`. Every key is optional.
`mfard --print-config` prints a file with all keys and defaults, `mfard --check-config --config FILE` checks one:
an unknown key, a wrong type, a value out of range or the name of an unusable file is refused with file, line and
column. Options of the command line, in brackets behind the key, override the file.

In the configuration file, relative paths of files that mfard reads start at the folder of that file. Relative paths of
files and folders that it writes start at its working directory (`/var/lib/mfar` for the service). Paths on the command
line start at the current folder.

Changes take effect after a restart. In sections marked *reload*, they also take effect after `systemctl reload mfard`,
`mfarctl reload` or SIGHUP. If the new file is invalid, mfard keeps the old configuration.
[architecture.md](architecture.md) says how mfard works with these settings.
)";

constexpr std::string_view kLevels = R"(
# Levels of the governor

`table` in `[governor]` names a file with one section `[[level]]` for each step between fast and accurate.
`mfar-bench pareto --table FILE` measures and writes it.
)";

std::string markdown(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '|' || c == '<' || c == '*') out += '\\';
        out += c;
    }
    return out;
}

std::string typeOf(const Option& option) {
    switch (option.type) {
    case OptionType::Text: return "text";
    case OptionType::Word: return "word";
    case OptionType::Texts: return "list of texts";
    case OptionType::Flag: return "true or false";
    case OptionType::Whole: return "whole number";
    case OptionType::Number: return "number";
    case OptionType::Numbers: return fmt::format("{} numbers", option.count);
    case OptionType::Values: return "values by name";
    }
    return "";
}

std::string section(const OptionSection& of) {
    const bool isList = of.kind == OptionSection::Kind::List;
    std::string out = of.name.empty()
                          ? "\n## Before all sections\n\n"
                          : fmt::format("\n## {}{}{}{}\n\n", isList ? "[[" : "[", of.name,
                                        isList ? "]]" : "]", of.isReloadable ? " *reload*" : "");
    if (!of.meaning.empty()) out += markdown(of.meaning) + "\n\n";
    out += "| key | type | default | meaning |\n|---|---|---|---|\n";
    for (const Option& option : of.options) {
        const std::string about = describe(option);
        out += fmt::format("| `{}`{} | {} | {} | {} |\n", option.name,
                           option.argument.empty() ? "" : fmt::format(" (`{}`)", option.argument),
                           typeOf(option),
                           option.isAbsent ? "absent" : fmt::format("`{}`", option.byDefault),
                           about.empty() ? "see the key of the same name above" : markdown(about));
    }
    return out;
}

}  // namespace

std::string configurationPage() {
    std::string out(kIntroduction);
    for (const OptionSection& one : configOptions())
        out += section(one);
    out += kLevels;
    for (const OptionSection& one : levelOptions())
        out += section(one);
    return out;
}

}  // namespace mfar::test
