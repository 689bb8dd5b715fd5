#include "daemon/tools/ctl_arguments.h"

#include "daemon/tools/command_failure.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace mfar {
namespace {

/// Refuses a file whose name promises another format than PNG. Links and special files, such as
/// /dev/stdout, may have any name.
std::string snapshotFault(const std::string& name) {
    std::string ending = std::filesystem::path(name).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (name == "-" || ending == ".png") return "";
    std::error_code ignored;
    const auto type = std::filesystem::symlink_status(name, ignored).type();
    if (type != std::filesystem::file_type::not_found &&
        type != std::filesystem::file_type::regular)
        return "";
    return name + ": the name must end with .png, because the picture is a PNG file";
}

}  // namespace

CtlParser::CtlParser() {
    CtlArguments& a = arguments;
    app.add_option("--socket", a.socket, "Socket on which mfard listens (its option --control)")
        ->capture_default_str()
        ->type_name("SOCKET");
    app.add_subcommand("status", "Show the state of mfard");
    app.add_subcommand("stats", "Show everything that mfard has measured since its start (JSON)");
    app.add_subcommand("reload", "Read the configuration file again");
    app.add_subcommand("trigger", "Request one still");
    CLI::App* snapshot = app.add_subcommand("snapshot", "Save the last picture that mfard made");
    snapshot->add_option("FILE", a.snapshot, "PNG file; -: standard output")
        ->required()
        ->check(CLI::Validator(snapshotFault, ""));
    snapshot->add_flag("--screen", a.screen, "Save the picture as the screen shows it");
    CLI::App* record = app.add_subcommand("record", "Record video and stills");
    CLI::Option* name = record->add_option("NAME", a.record,
                                           "New folder in mfard's working directory, which is\n"
                                           "/var/lib/mfar for the service");
    record->add_flag("--stop", a.stop, "End the recording")->excludes(name);
    record->require_option(1);
    app.add_subcommand("learn", "Manage the filters that mfard has learned for the two sensors")
        ->require_subcommand(1)
        ->add_subcommand("reset", "Delete the learned filters and start learning again");
    app.require_subcommand(1);
    app.failure_message(commandFailure);
    app.set_version_flag("--version", "mfarctl " MFAR_VERSION);
}

}  // namespace mfar
