#pragma once

#include "hal/gl_context.h"

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

/// Adds the option --engine.
void addEngine(CLI::App& app, std::string& engine);

/// Sets the engine of all pipelines that are created later without a choice of engines, see
/// EngineChoice::fromEnvironment(). `wish` is "gles", "simd" or "auto". "auto" keeps the
/// environment variable MFAR_ENGINE. If it is not set, "auto" means simd if OpenGL ES runs on the
/// CPU, otherwise gles. To find this out, OpenGL ES is needed; std::runtime_error is thrown if
/// it is not available.
void useEngine(const std::string& wish);

/// Returns for example "engine simd; Mesa llvmpipe ...", with the engine that useEngine() set.
[[nodiscard]] std::string engineAndRenderer(const GlContext& context);

}  // namespace mfar::eval
