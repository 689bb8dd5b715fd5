#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace mfar {

/// Values of the command line of mfarctl.
struct CtlArguments {
    std::string socket = "/run/mfar/control";
    std::string snapshot;
    bool screen = false;
    std::string record;
    bool stop = false;
};

/// The command line parser of mfarctl, for the program and its manual page.
struct CtlParser {
    CtlParser();

    CLI::App app{"mfarctl: queries and controls a running mfard.\n", "mfarctl"};
    CtlArguments arguments;
};

}  // namespace mfar
