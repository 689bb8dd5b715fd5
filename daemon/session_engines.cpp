#include "daemon/session_engines.h"

#include "daemon/engine_memory.h"
#include "daemon/virtual_world.h"
#include "pipeline/engine_guess.h"
#include "pipeline/engine_trial.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace mfar {

OpenedGl openGl(const Config& config, GlDevice device) {
    const bool drawsElsewhere =
        (!config.objects.empty() && VirtualWorld::drawsPreviews(config.virtualLayer)) ||
        config.validate;
    if (config.engine.isSimdAlone() && !drawsElsewhere) return {};
    std::unique_ptr<GlContext> context;
    try {
        context = createGlContext(device);
    } catch (const std::runtime_error& error) {
        if (config.engine.needsGles() || config.validate)
            throw Failure(ExitCode::Unavailable, error.what());
        return {nullptr, error.what()};
    }
    if (context->isSoftware() && !config.engine.needsGles() && !drawsElsewhere) return {};
    return {std::move(context), ""};
}

EngineChoice chooseEngines(const Config& config, const GlContext* gl, const StereoRig& rig,
                           Size output) {
    const EngineConfig& engine = config.engine;
    if (config.validate) return withWishes(engine, EngineChoice::all(EngineKind::Gles));
    if (gl == nullptr || gl->isSoftware())
        return withWishes(engine, EngineChoice::all(EngineKind::Simd));
    if (!fitsGpu(rig, output)) {
        const EngineChoice choice = withWishes(engine, EngineChoice::all(EngineKind::Simd));
        if (choice.uses(EngineKind::Gles))
            throw Failure(ExitCode::Unavailable,
                          fmt::format("engine gles: the pictures are too large for the textures of "
                                      "{}; use engine simd or smaller pictures",
                                      gl->description()));
        return choice;
    }
    const std::string key =
        fmt::format("{}; video {}x{}, still {}x{}, output {}x{}", gl->description(),
                    rig.video.size.width, rig.video.size.height, rig.still.size.width,
                    rig.still.size.height, output.width, output.height);
    const std::filesystem::path file = engineMemoryFile();
    std::optional<EngineChoice> decided = rememberedEngines(file, key);
    const bool isOpen = withWishes(engine, EngineChoice::all(EngineKind::Gles)) !=
                        withWishes(engine, EngineChoice::all(EngineKind::Simd));
    if (!decided && isOpen) {
        const std::vector<EngineChoice> placements = promisingEngines(gl->description());
        decided = placements.front();
        if (placements.size() > 1) {
            decided = tryEngines(placements, rig, output, EngineKind::Gles).front().engines;
            rememberEngines(file, key, *decided);
        }
    }
    return withWishes(engine, decided.value_or(EngineChoice::all(EngineKind::Gles)));
}

}  // namespace mfar
