#include "daemon/tools/sim_writer.h"
#include "hal/virtual/synthetic_board.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace mfar {
namespace {

using synthetic::Path;

constexpr std::array kScenes{synthetic::Scene::Office,     synthetic::Scene::Shelf,
                             synthetic::Scene::Outdoor,    synthetic::Scene::Flat,
                             synthetic::Scene::Moving,     synthetic::Scene::Still,
                             synthetic::Scene::Calibration};
constexpr std::array kPaths{Path::Handheld, Path::Pan,  Path::Orbit, Path::Forward,
                            Path::Rotate,   Path::Rest, Path::Survey};

template <class T, std::size_t N>
std::vector<std::string> names(const std::array<T, N>& values) {
    std::vector<std::string> out;
    for (const T v : values)
        out.emplace_back(synthetic::name(v));
    return out;
}

struct Arguments {
    std::string scene = "office", path;
    double seconds = 2, rateHz = 30;
    bool list = false, noTruth = false;
    SyntheticOptions board;
    SimOptions sim;
};

void declare(CLI::App& app, Arguments& a) {
    app.add_option("--scene", a.scene, "scene in front of the cameras")
        ->check(CLI::IsMember(names(kScenes)))
        ->capture_default_str();
    app.add_option("--path", a.path,
                   "how the camera moves (default: handheld; rest in scene still, "
                   "survey in calibration)")
        ->check(CLI::IsMember(names(kPaths)));
    app.add_option("--seconds", a.seconds, "length of the recording [s]")
        ->check(CLI::Range(0.01, 3600.0))
        ->capture_default_str();
    app.add_option("--rate", a.rateHz, "video frames per second")
        ->check(CLI::Range(1.0, 1000.0))
        ->capture_default_str();
    app.add_option("--stills", a.sim.stillsHz, "stills per second; 0: no stills")
        ->check(CLI::Range(0.0, 10.0))
        ->capture_default_str();
    app.add_option("--seed", a.board.seed,
                   "seed of the random numbers: the same seed gives the same bytes")
        ->capture_default_str();
    app.add_option("--noise", a.board.noise, "factor of the sensors' noise")
        ->check(CLI::Range(0.0, 100.0))
        ->capture_default_str();
    app.add_option("--out", a.sim.out, "folder to write the recording into, new or empty");
    app.add_flag("--no-truth", a.noTruth, "do not write truth/, the ground truth");
    app.add_flag("--list", a.list, "print the names of all scenes and paths, then exit");
}

void showProgress(int done, int total) {
    constexpr int kWidth = 40;
    const int filled = total > 0 ? done * kWidth / total : kWidth;
    fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {}/{} frames", "", filled, "", kWidth - filled, done,
               total);
    if (done == total) fmt::print(stderr, "\n");
    std::fflush(stderr);
}

int list() {
    fmt::print("scenes:");
    for (const std::string& s : names(kScenes))
        fmt::print(" {}", s);
    fmt::print("\npaths:");
    for (const std::string& s : names(kPaths))
        fmt::print(" {}", s);
    fmt::print("\n");
    return 0;
}

/// Writes a description of the target of scene Calibration, for mfar-calibrate and Kalibr.
void writeGrid(const std::filesystem::path& file) {
    std::ofstream out(file);
    out << fmt::format("target_type: 'aprilgrid'\ntagCols: {0}\ntagRows: {0}\n"
                       "tagSize: {1}  # [m]\ntagSpacing: {2}  # gap / tagSize\n",
                       synthetic::kGridTags, synthetic::kGridTagSize, synthetic::kGridSpacing);
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

int simulate(Arguments a) {
    a.board.scene = *synthetic::sceneNamed(a.scene);
    if (!a.path.empty()) a.board.path = synthetic::pathNamed(a.path);
    a.board.pace = Pace::Consumer;
    a.board.rateHz = a.rateHz;
    a.board.frames = std::max(1, static_cast<int>(std::lround(a.seconds * a.rateHz)));
    a.sim.highRes = a.sim.depth = a.sim.flow = !a.noTruth;
    const bool terminal = isatty(STDERR_FILENO) == 1;
    SyntheticBoard board(a.board);
    const SimCounts counts = writeSimulation(board, a.sim, [&](int done) {
        if (terminal) showProgress(done, a.board.frames);
    });
    if (a.board.scene == synthetic::Scene::Calibration) writeGrid(a.sim.out / "aprilgrid.yaml");
    fmt::print("{}: {} video frames, {} stills, {} flow fields\n", a.sim.out.string(), counts.video,
               counts.stills, counts.flows);
    return 0;
}

}  // namespace
}  // namespace mfar

int main(int argc, char** argv) {
    CLI::App app("Writes a recording of the synthetic board, with ground truth", "mfar-sim");
    mfar::Arguments arguments;
    mfar::declare(app, arguments);
    CLI11_PARSE(app, argc, argv);
    try {
        if (arguments.list) return mfar::list();
        if (arguments.sim.out.empty()) throw std::runtime_error("the option --out DIR is needed");
        return mfar::simulate(arguments);
    } catch (const std::exception& e) {
        fmt::print(stderr, "mfar-sim: {}\n", e.what());
        return 1;
    }
}
