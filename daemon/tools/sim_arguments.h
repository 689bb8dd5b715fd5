#pragma once

#include "daemon/tools/sim_writer.h"
#include "hal/virtual/synthetic_board.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace mfar {

[[nodiscard]] std::vector<std::string> simSceneNames();
[[nodiscard]] std::vector<std::string> simPathNames();

struct SimArguments {
    std::string scene = "office", path;
    double seconds = 2, rateHz = 30;
    bool list = false, noTruth = false;
    SyntheticOptions board;
    SimOptions sim;
};

struct SimParser {
    SimParser();

    CLI::App app{"Writes a recording of the synthetic board, with ground truth", "mfar-sim"};
    SimArguments arguments;
};

}  // namespace mfar
