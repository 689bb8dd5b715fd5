#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace mfar {

struct CtlArguments {
    std::string socket = "/run/mfar/control";
    std::string snapshot;
    bool screen = false;
    std::string record;
    bool stop = false;
};

struct CtlParser {
    CtlParser();

    CLI::App app{"mfarctl: queries and controls a running mfard.\n", "mfarctl"};
    CtlArguments arguments;
};

}  // namespace mfar
