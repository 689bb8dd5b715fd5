#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace mfar {

/// Returns the message of a failed parse, for CLI::App::failure_message(). If a subcommand is
/// missing or unknown, the message names the unknown argument and the valid subcommands; CLI11's
/// own message names neither.
[[nodiscard]] std::string commandFailure(const CLI::App* app, const CLI::Error& error);

}  // namespace mfar
