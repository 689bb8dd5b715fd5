#include "daemon/tools/command_failure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace mfar {
namespace {

// Returns the innermost subcommand of the command line. The error belongs to the arguments of that
// subcommand.
const CLI::App& innermost(const CLI::App& app) {
    const std::vector<CLI::App*> used = app.get_subcommands();
    return used.empty() ? app : innermost(*used.front());
}

std::string withName(const CLI::App& app, const std::string& message) {
    const std::string prefix = app.get_name() + ": ";
    return message.starts_with(prefix) ? message : prefix + message;
}

}  // namespace

std::string commandFailure(const CLI::App* app, const CLI::Error& error) {
    const CLI::App& at = innermost(*app);
    if (error.get_name() != "RequiredError" || at.get_require_subcommand_min() == 0)
        return withName(*app, CLI::FailureMessage::simple(app, error));
    std::vector<std::string> names;
    for (const CLI::App* each : at.get_subcommands([](const CLI::App*) { return true; }))
        if (!each->get_name().empty()) names.push_back(each->get_name());
    const std::vector<std::string> unknown = at.remaining();
    const std::string fault =
        unknown.empty() ? "a command is missing" : fmt::format("unknown command '{}'", unknown[0]);
    return fmt::format("{}: {}; expected one of {}\nRun with --help for more information.\n",
                       at.get_name(), fault, fmt::join(names, ", "));
}

}  // namespace mfar
