#include "daemon/tools/sim_arguments.h"

#include "daemon/number_range.h"
#include "daemon/tools/command_failure.h"

#include <array>

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

}  // namespace

std::vector<std::string> simSceneNames() {
    return names(kScenes);
}

std::vector<std::string> simPathNames() {
    return names(kPaths);
}

SimParser::SimParser() {
    SimArguments& a = arguments;
    app.add_option("--scene", a.scene, "scene in front of the cameras")
        ->check(CLI::IsMember(simSceneNames()))
        ->capture_default_str();
    app.add_option("--path", a.path,
                   "how the camera moves; default: \"rest\" in the scene \"still\", \"survey\" in "
                   "the scene \"calibration\", \"handheld\" in all other scenes")
        ->check(CLI::IsMember(simPathNames()));
    app.add_option("--seconds", a.seconds, "length of the recording [s]")
        ->check(numberFrom(0.01, 3600))
        ->capture_default_str();
    app.add_option("--rate", a.rateHz, "video frames per second")
        ->check(numberFrom(1, 1000))
        ->capture_default_str();
    const CLI::Option* stills =
        app.add_option("--stills", a.sim.stillsHz, "stills per second; 0: no stills")
            ->check(numberFrom(0, 10))
            ->capture_default_str();
    app.add_option("--seed", a.board.seed,
                   "seed of the random numbers: the same seed gives the same bytes")
        ->check(unsigned64())
        ->capture_default_str();
    app.add_option("--noise", a.board.noise, "factor of the noise of both sensors; 0: no noise")
        ->check(numberFrom(0, 100))
        ->capture_default_str();
    app.add_option("--out", a.sim.out, "folder to write the recording into, new or empty");
    app.add_flag("--no-truth", a.noTruth, "do not write truth/, the ground truth");
    app.add_flag("--list", a.list, "print the names of all scenes and paths, then exit");
    app.failure_message(commandFailure);
    app.callback([&a, stills] {
        if (!a.list && a.sim.out.empty()) throw CLI::RequiredError("--out");
        if (stills->count() == 0) a.sim.stillsHz = std::min(a.sim.stillsHz, a.rateHz);
        if (a.sim.stillsHz > a.rateHz)
            throw CLI::ValidationError(
                "--stills", "must not exceed --rate: a still is taken with a video frame");
    });
}

}  // namespace mfar
