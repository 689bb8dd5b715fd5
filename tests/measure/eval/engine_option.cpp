#include "tests/measure/eval/engine_option.h"

#include "pipeline/engine/engine.h"

#include <fmt/format.h>

#include <cstdlib>

namespace mfar::eval {

void addEngine(CLI::App& app, std::string& engine) {
    app.add_option("--engine", engine,
                   "engine of all steps; auto: the environment variable MFAR_ENGINE; if it is not "
                   "set, simd if OpenGL ES runs on the CPU, otherwise gles")
        ->check(CLI::IsMember({"auto", "gles", "simd"}))
        ->capture_default_str();
}

void useEngine(const std::string& wish) {
    const char* set = std::getenv("MFAR_ENGINE");
    if (wish == "auto" && set != nullptr && *set != '\0') return;
    const bool isSimd = wish == "simd" || (wish == "auto" && createGlContext()->isSoftware());
    setenv("MFAR_ENGINE", nameOf(isSimd ? EngineKind::Simd : EngineKind::Gles).data(), 1);
}

std::string engineAndRenderer(const GlContext& context) {
    return fmt::format("engine {}; {}", nameOf(EngineChoice::fromEnvironment().detail),
                       context.description());
}

}  // namespace mfar::eval
