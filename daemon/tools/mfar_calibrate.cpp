#include "daemon/tools/calibrate/collect.h"
#include "daemon/tools/calibrate/report.h"
#include "daemon/tools/calibrate/residual_picture.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace mfar::calibration {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    fs::path recording, aprilGridFile, out;
    std::string board;
    double square = 0;
    SolveOptions solve;
};

void declare(CLI::App& app, Arguments& a) {
    app.add_option("recording", a.recording,
                   "recording to read: folder in EuRoC layout, cam0 video, cam1 stills")
        ->required();
    auto* grid = app.add_option("--aprilgrid", a.aprilGridFile,
                                "target: Kalibr's description of an aprilgrid (YAML)");
    auto* board =
        app.add_option("--checkerboard", a.board,
                       "target: checkerboard with this number of inner corners, like 9x6");
    auto* square =
        app.add_option("--square", a.square, "edge length of a square of the checkerboard [m]");
    grid->excludes(board);
    board->needs(square);
    square->needs(board);
    app.add_option("--out", a.out,
                   "folder to write: rig.yaml, video.yaml, still.yaml, residuals.png")
        ->required();
    app.add_option("--max-offset", a.solve.maxOffset,
                   "largest clock offset that is searched, positive or negative [s]; 0: the offset "
                   "is taken as 0")
        ->check(CLI::Range(0.0, 2.0))
        ->capture_default_str();
    app.add_flag("--k3", a.solve.k3,
                 "estimate the third radial distortion coefficient as well, for wide lenses");
}

Target targetOf(const Arguments& a) {
    if (!a.aprilGridFile.empty()) return readAprilGrid(a.aprilGridFile);
    if (!a.board.empty()) return checkerboard(a.board, a.square);
    throw std::runtime_error(
        "a target is needed: --aprilgrid FILE or --checkerboard 9x6 --square 0.025");
}

/// Searches for the target in all pictures. On a terminal, the coverage map is redrawn after each
/// picture; otherwise it is printed once at the end.
SensorViews look(const std::vector<RecordedImage>& pictures, Size size, const Target& target,
                 const char* name) {
    const bool terminal = isatty(STDOUT_FILENO) == 1;
    std::string shown;
    SensorViews out = collect(pictures, size, target, [&](const Progress& now) {
        const bool last = now.done == now.of;
        if (!last && (!terminal || now.done % 5 != 0)) return;
        const std::string title =
            fmt::format("{}: {} of {} pictures, {} show the target, {:.0f} % covered   ", name,
                        now.done, now.of, now.found, 100 * now.coverage.share());
        if (terminal && !shown.empty()) fmt::print("\x1b[{}A", Coverage::kRows + 3);
        shown = mapText(now.coverage, title);
        fmt::print("{}", shown);
        std::fflush(stdout);
    });
    return out;
}

void run(const Arguments& a) {
    const Target target = targetOf(a);
    const Recording recording = loadRecording(a.recording);
    const SensorViews video = look(recording.video, recording.rig.video.size, target, "video");
    const SensorViews still = look(recording.stills, recording.rig.still.size, target, "still");
    const Calibration calibration = calibrate(target, video, still, a.solve);
    fmt::print("{}{}", viewsText(calibration), resultText(calibration));
    saveRig(a.out, calibration.rig);
    saveResidualPicture(a.out / "residuals.png", calibration);
    fmt::print("written: rig.yaml video.yaml still.yaml residuals.png in {}\n", a.out.string());
}

}  // namespace
}  // namespace mfar::calibration

int main(int argc, char** argv) {
    CLI::App app("Calibrates both sensors of a board from a recording of a flat target",
                 "mfar-calibrate");
    mfar::calibration::Arguments arguments;
    mfar::calibration::declare(app, arguments);
    CLI11_PARSE(app, argc, argv);
    try {
        mfar::calibration::run(arguments);
        return 0;
    } catch (const std::exception& e) {
        fmt::print(stderr, "mfar-calibrate: {}\n", e.what());
        return 1;
    }
}
