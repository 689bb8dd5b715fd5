#pragma once

#include "daemon/tools/calibrate/solve.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace mfar::calibration {

struct CalibrateArguments {
    std::filesystem::path recording, aprilGridFile, out;
    std::string board;
    double square = 0;
    SolveOptions solve;
};

struct CalibrateParser {
    CalibrateParser();

    CLI::App app{"Calibrates both sensors of a board from a recording of a flat target",
                 "mfar-calibrate"};
    CalibrateArguments arguments;
};

}  // namespace mfar::calibration
