#include "daemon/option_text.h"
#include "daemon/options.h"
#include "tests/texts/pages.h"
#include "tests/texts/troff.h"

#include <fmt/format.h>

#include <algorithm>

namespace mfar::test {
namespace {

std::string valuesOf(const ArgumentText& argument) {
    for (const OptionSection& section : configOptions())
        for (const Option& option : section.options)
            if (option.argument == longName(argument)) return std::string(option.words);
    return "";
}

std::string manSection(const OptionSection& section) {
    const bool isList = section.kind == OptionSection::Kind::List;
    std::string out = section.name.empty() ? std::string(".SH \"BEFORE ALL SECTIONS\"\n")
                                           : fmt::format(".SH \"{}{}{}{}\"\n", isList ? "[[" : "[",
                                                         section.name, isList ? "]]" : "]",
                                                         section.isReloadable ? " (reload)" : "");
    if (!section.meaning.empty()) out += troff(section.meaning) + "\n";
    for (const Option& option : section.options) {
        const std::string about = describe(option);
        out += entry(fmt::format("{} = {}", option.name, option.byDefault),
                     about.empty() ? "See the key of the same name above." : about);
    }
    return out;
}

}  // namespace

std::string longName(const ArgumentText& argument) {
    return argument.names.substr(argument.names.rfind(',') + 1);
}

std::string programManPage() {
    std::string out =
        head("mfard", 1, "lifts a fast video sensor to the resolution of a still sensor",
             "daemon/option_table.cpp and options.cpp");
    out += ".SH SYNOPSIS\n.B mfard\n[OPTIONS]\n.SH OPTIONS\n";
    for (const ArgumentText& argument : argumentTexts())
        out += entry(argument);
    out += ".SH SIGNALS\nTERM and INT end mfard; HUP makes it read its configuration again.\n"
           ".SH \"EXIT STATUS\"\n" +
           entry("0", "success") + entry("64", "wrong command line") +
           entry("65", "wrong data in a file") + entry("66", "a file cannot be read") +
           entry("69", "a device or OpenGL ES is not available") +
           entry("70", "any other failure") +
           entry("74", "a display, recording, summary or report cannot be written") +
           entry("78", "wrong configuration") +
           entry("130, 143", "a second SIGINT or SIGTERM ended mfard at once") +
           ".SH \"SEE ALSO\"\n.BR mfard.toml (5)\n";
    return out;
}

std::string configManPage() {
    std::string out = head("mfard.toml", 5, "configuration of mfard", "daemon/option_table.cpp");
    out += ".SH DESCRIPTION\n" +
           troff("A TOML file. Every key is optional. Changes take effect after a restart. "
                 "In sections marked (reload), they also take effect after a reload. Paths of "
                 "files that mfard reads start at this file's folder, paths of what it writes at "
                 "its working directory.") +
           "\n";
    for (const OptionSection& section : configOptions())
        out += manSection(section);
    out +=
        ".SH \"LEVELS OF THE GOVERNOR\"\n" +
        troff("The file that \"table\" in [governor] names has one section [[level]] for each step "
              "between fast and accurate. \"mfar-bench pareto --table FILE\" writes it.") +
        "\n";
    for (const OptionSection& section : levelOptions())
        out += manSection(section);
    return out + ".SH \"SEE ALSO\"\n.BR mfard (1)\n";
}

std::string bashCompletion() {
    std::string words, cases, files, others;
    const auto add = [](std::string& list, std::string_view separator, const std::string& one) {
        list += list.empty() ? one : std::string(separator) + one;
    };
    for (const ArgumentText& argument : argumentTexts()) {
        const std::string name = longName(argument);
        add(words, " ", name);
        if (const std::string values = valuesOf(argument); !values.empty())
            cases += fmt::format("    {}) words='{}' ;;\n", name, values);
        else if (argument.value == "FILE" || argument.value == "DIR" || argument.value == "SOCKET")
            add(files, " | ", name);
        else if (!argument.value.empty())
            add(others, " | ", name);
    }
    return fmt::format(R"(# Completion of mfard's options in bash. Printed by mfar-texts.
_mfard() {{
    local words
    case $3 in
{}    {}) mapfile -t COMPREPLY < <(compgen -f -- "$2"); return ;;
    {}) COMPREPLY=(); return ;;
    *) words='{}' ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$2")
}}
complete -o filenames -F _mfard mfard
)",
                       cases, files, others, words);
}

}  // namespace mfar::test
