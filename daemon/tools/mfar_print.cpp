#include "base/calibration/calibration_error.h"
#include "base/whole_file.h"
#include "daemon/after_output.h"
#include "daemon/exit_code.h"
#include "daemon/output_checks.h"
#include "daemon/tools/april_grid_text.h"
#include "daemon/tools/print/arguments.h"
#include "daemon/tools/print/printed_targets.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace mfar::print {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
    writeWholeFile(file, text);
    fmt::print("written: {}\n", file.string());
}

void printTags(const PrintArguments& a) {
    write(a.out, tagPage(*tagFamilyNamed(a.family), a.ids, a.tagSize, paperNamed(a.paper)));
}

/// Throws if the description would replace another file, or cannot be written.
void requireReplaceable(const std::filesystem::path& description) {
    const std::string name = description.string();
    if (const std::string fault = fileToWrite()(name); !fault.empty())
        throw std::runtime_error(fault);
    if (!std::filesystem::exists(description)) return;
    try {
        (void)calibration::readAprilGrid(description);
    } catch (const CalibrationError&) {
        throw std::runtime_error(
            name + " is not the description of an AprilGrid and would be replaced; choose another "
                   "name for --out");
    }
}

void printGrid(const PrintArguments& a) {
    calibration::checkTagCount(a.columns * a.rows);
    const Paper& paper = paperNamed(a.paper);
    const double size =
        a.gridTagSize > 0 ? a.gridTagSize : largestTag(a.columns, a.rows, a.spacing, paper);
    const std::string page =
        gridPage(calibration::aprilGrid(a.columns, a.rows, size, a.spacing), paper);
    const auto description = std::filesystem::path(a.out).replace_extension(".yaml");
    requireReplaceable(description);
    const std::string text = aprilGridText(a.columns, a.rows, size, a.spacing);
    const NewFile files[] = {{a.out, page}, {description, text}};
    writeWholeFiles(files);
    fmt::print("written: {}\nwritten: {}\n", a.out.string(), description.string());
}

void printBoard(const PrintArguments& a) {
    const Paper& paper = paperNamed(a.paper);
    // The size does not matter for the numbers of corners, which are checked first.
    const calibration::Target any = calibration::checkerboard(a.board, 1);
    const double square = a.square > 0 ? a.square : largestSquare(any.columns, any.rows, paper);
    write(a.out, boardPage(calibration::checkerboard(a.board, square), paper));
    fmt::print("for mfar-calibrate: --checkerboard {} --square {:g}\n", a.board, square);
}

void run(const PrintParser& parser) {
    if (parser.tags->parsed()) return printTags(parser.arguments);
    if (parser.grid->parsed()) return printGrid(parser.arguments);
    printBoard(parser.arguments);
}

}  // namespace
}  // namespace mfar::print

int main(int argc, char** argv) {
    mfar::print::PrintParser parser;
    try {
        parser.app.parse(argc, argv);
        mfar::print::run(parser);
        return mfar::afterOutput(0, "mfar-print", 1);
    } catch (const CLI::ParseError& error) {
        if (parser.app.exit(error) != 0) return static_cast<int>(mfar::ExitCode::Usage);
        return mfar::afterOutput(0, "mfar-print", 1);
    } catch (const std::exception& e) {
        fmt::print(stderr, "mfar-print: {}\n", e.what());
        return 1;
    }
}
