#include "daemon/tools/calibrate/arguments.h"
#include "daemon/tools/ctl_arguments.h"
#include "daemon/tools/print/arguments.h"
#include "daemon/tools/sim_arguments.h"
#include "tests/texts/pages.h"
#include "tests/texts/troff.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace mfar::test {
namespace {

/// Texts of a manual page that the command-line parser does not contain.
struct Tool {
    const char* about;
    const char* source;
    const char* description;
    std::vector<std::pair<const char*, const char*>> exitStatus;
};

constexpr const char* kParser = "wrong command line";

std::string synopsis(const CLI::App& app) {
    std::string options, positional;
    for (const ArgumentText& argument : argumentTexts(app)) {
        if (argument.names.find("--help") != std::string::npos) continue;
        std::string one = argument.names;
        if (!argument.isPositional() && !argument.value.empty())
            one.append(" ").append(argument.value);
        if (!argument.isRequired) one = fmt::format("[{}]", one);
        (argument.isPositional() ? positional : options).append(" ").append(one);
    }
    return options + positional;
}

/// Returns entries for all arguments of `app`, and for all its commands with their arguments.
/// `path`: names of the commands that lead to `app`, each followed by a space; empty for the
/// program itself.
std::string arguments(const CLI::App& app, const std::string& path) {
    std::string out;
    for (const ArgumentText& argument : argumentTexts(app))
        if (path.empty() || argument.names.find("--help") == std::string::npos)
            out += entry(argument);
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    if (commands.empty()) return out;
    if (path.empty()) out += ".SH COMMANDS\n";
    for (const CLI::App* command : commands) {
        const std::string name = path + command->get_name();
        out += entry(name + synopsis(*command), command->get_description());
        const std::string own = arguments(*command, name + " ");
        if (!own.empty()) out += ".RS\n" + own + ".RE\n";
    }
    return out;
}

std::string page(const CLI::App& app, const Tool& tool) {
    const std::string& name = app.get_name();
    const bool hasCommands = !app.get_subcommands([](const CLI::App*) { return true; }).empty();
    std::string out = head(name, 1, tool.about, tool.source);
    out += ".SH SYNOPSIS\n.B " + troff(name) + "\n";
    out += hasCommands ? "[OPTIONS] COMMAND\n" : "[OPTIONS]";
    for (const ArgumentText& argument : argumentTexts(app))
        if (!hasCommands && argument.isPositional()) out += " " + troff(argument.names);
    if (!hasCommands) out += "\n";
    out += ".SH DESCRIPTION\n" + troff(tool.description) + "\n.SH OPTIONS\n" + arguments(app, "");
    out += ".SH \"EXIT STATUS\"\n";
    for (const auto& [code, meaning] : tool.exitStatus)
        out += entry(code, meaning);
    return out + ".SH \"SEE ALSO\"\n.BR mfard (1),\n.BR mfard.toml (5)\n";
}

std::vector<std::string> commandsOf(const CLI::App& app) {
    std::vector<std::string> out;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        out.push_back(command->get_name());
    return out;
}

/// Returns assignments of bash: `words` to all options and commands of `app`, and `files` if an
/// argument is a file.
std::string completedWords(const CLI::App& app) {
    std::vector<std::string> words = commandsOf(app);
    bool takesFile = false;
    for (const ArgumentText& argument : argumentTexts(app)) {
        if (!argument.isPositional()) words.push_back(longName(argument));
        takesFile = takesFile || argument.names == "FILE";
    }
    return fmt::format("words='{}'{}", fmt::join(words, " "), takesFile ? " files=1" : "");
}

}  // namespace

std::string controlManPage() {
    return page(
        CtlParser().app,
        {"queries and controls a running mfard",
         "daemon/tools/ctl_arguments.cpp",
         "Sends one command to mfard through its control socket and prints the answer. root and "
         "members of the group mfar may use status and stats; all other commands need root, "
         "or the groups mfar and mfar-operators.",
         {{"0", "success"},
          {"1", "mfard refused the command"},
          {"64", kParser},
          {"69", "no mfard answers at the socket, or the user may not use it"},
          {"74", "a file cannot be written"}}});
}

std::string controlCompletion() {
    const CtlParser parser;
    std::string cases;
    for (const CLI::App* command : parser.app.get_subcommands([](const CLI::App*) { return true; }))
        cases += fmt::format("    {}) {} ;;\n", command->get_name(), completedWords(*command));
    return fmt::format(
        R"(# Completion of mfarctl's commands and options in bash. Printed by mfar-texts.
_mfarctl() {{
    local word command='' words files=''
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case $word in
        {}) command=$word && break ;;
        esac
    done
    case $command in
{}    *) {} ;;
    esac
    if [ "$3" = --socket ]; then words='' files=1; fi
    mapfile -t COMPREPLY < <(
        compgen -W "$words" -- "$2"
        [ -z "$files" ] || compgen -f -- "$2"
    )
}}
complete -o filenames -F _mfarctl mfarctl
)",
        fmt::join(commandsOf(parser.app), " | "), cases, completedWords(parser.app));
}

std::string simManPage() {
    return page(
        SimParser().app,
        {"writes a recording of the synthetic board",
         "daemon/tools/sim_arguments.cpp",
         "Draws what both sensors of a simulated board see and writes it as a recording in "
         "EuRoC layout, with poses, tags, calibration and, in truth/, the exact pictures, "
         "depth and flow. Needs --out, unless --list is given.",
         {{"0", "success"},
          {"1", "the recording or standard output cannot be written, or OpenGL ES is missing"},
          {"64", kParser}}});
}

std::string calibrateManPage() {
    return page(
        calibration::CalibrateParser().app,
        {"calibrates both sensors of a board",
         "daemon/tools/calibrate/arguments.cpp",
         "Finds an AprilGrid or a checkerboard in a recording of both sensors and writes "
         "lenses, their mutual pose and the offset of their clocks. Needs --out, and either "
         "--aprilgrid, or both --checkerboard and --square. Name the written folder as "
         "calibration in mfard.toml.",
         {{"0", "success"},
          {"1", "no target is given, the recording or target cannot be read, the recording is not "
                "sufficient for a calibration, or the result or standard output cannot be "
                "written"},
          {"64", kParser}}});
}

std::string printManPage() {
    return page(
        print::PrintParser().app,
        {"draws tags and calibration targets to print",
         "daemon/tools/print/arguments.cpp",
         "Writes an SVG file with one page that has the size of the paper. Print it at 100 %, for "
         "example with a web browser, and check the ruler on the print. A tag that is printed "
         "this way can be used for poses, and an AprilGrid or checkerboard for mfar-calibrate.",
         {{"0", "success"},
          {"1",
           "the family has no such tag, the checkerboard looks the same upside down, the target "
           "does not fit on the paper, or a file or standard output cannot be written"},
          {"64", kParser}}});
}

}  // namespace mfar::test
