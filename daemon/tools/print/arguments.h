#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::print {

struct PrintArguments {
    std::filesystem::path out;
    std::string paper = "a4";
    std::string family = "tag36h11";
    std::vector<int> ids;
    double tagSize = 0.1;
    int columns = 6, rows = 8;
    double spacing = 0.3;
    double gridTagSize = 0;  ///< 0: the largest that fits on the paper
    std::string board = "9x6";
    double square = 0;  ///< 0: the largest that fits on the paper
};

struct PrintParser {
    PrintParser();

    CLI::App app{"Draws tags and calibration targets to print, as SVG files", "mfar-print"};
    PrintArguments arguments;
    CLI::App *tags, *grid, *board;  ///< the commands
};

}  // namespace mfar::print
