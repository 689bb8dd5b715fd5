#include "base/progress.h"
#include "daemon/after_output.h"
#include "daemon/exit_code.h"
#include "daemon/tools/april_grid_text.h"
#include "daemon/tools/sim_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

namespace mfar {
namespace {

int list() {
    fmt::print("scenes: {}\npaths: {}\n", fmt::join(simSceneNames(), " "),
               fmt::join(simPathNames(), " "));
    return 0;
}

void writeGrid(const std::filesystem::path& file) {
    std::ofstream out(file);
    out << aprilGridText(synthetic::kGridTags, synthetic::kGridTags, synthetic::kGridTagSize,
                         synthetic::kGridSpacing);
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

int simulate(SimArguments a) {
    a.board.scene = *synthetic::sceneNamed(a.scene);
    if (!a.path.empty()) a.board.path = synthetic::pathNamed(a.path);
    a.board.pace = Pace::Consumer;
    a.board.rateHz = a.rateHz;
    a.board.frames = std::max(1, static_cast<int>(std::lround(a.seconds * a.rateHz)));
    a.sim.highRes = a.sim.depth = a.sim.flow = !a.noTruth;
    Progress progress;
    SyntheticBoard board(a.board);
    const SimCounts counts = writeSimulation(board, a.sim, [&](int done) {
        const auto count = static_cast<std::size_t>(a.board.frames);
        ProgressPart(progress).show(static_cast<std::size_t>(done), count,
                                    fmt::format("{} of {} frames", done, count));
    });
    progress.clear();
    if (a.board.scene == synthetic::Scene::Calibration) writeGrid(a.sim.out / "aprilgrid.yaml");
    fmt::print("{}: {} video frames, {} stills, {} flow fields\n", a.sim.out.string(), counts.video,
               counts.stills, counts.flows);
    return 0;
}

}  // namespace
}  // namespace mfar

int main(int argc, char** argv) {
    mfar::SimParser parser;
    try {
        parser.app.parse(argc, argv);
        const mfar::SimArguments& arguments = parser.arguments;
        const int status = arguments.list ? mfar::list() : mfar::simulate(arguments);
        return mfar::afterOutput(status, "mfar-sim", 1);
    } catch (const CLI::ParseError& error) {
        if (parser.app.exit(error) != 0) return static_cast<int>(mfar::ExitCode::Usage);
        return mfar::afterOutput(0, "mfar-sim", 1);
    } catch (const std::exception& e) {
        fmt::print(stderr, "mfar-sim: {}\n", e.what());
        return 1;
    }
}
