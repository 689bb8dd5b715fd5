#pragma once

#include "daemon/config.h"
#include "hal/gl_context.h"
#include "pipeline/engine/engine.h"

#include <memory>
#include <string>

namespace mfar {

struct OpenedGl {
    std::unique_ptr<GlContext> context;  ///< current on this thread; null: GL is not used
    std::string without;  ///< reason why GL could not be opened; empty: it is open or not needed
};

/// Opens GL if a step may run on GLES, or if previews of objects or validation need GL. Closes GL
/// again if it is a software renderer that is not needed: no step is configured to run on GLES, and
/// neither previews nor validation need GL. Throws Failure if GL cannot be opened, but a step is
/// configured to run on GLES or shader outputs are validated.
[[nodiscard]] OpenedGl openGl(const Config& config, GlDevice device);

/// Chooses the engine of each step. If an engine is configured for a step, it is used. For the
/// other steps ("auto"), these rules apply, in this order:
///   - If shader outputs are validated, GLES is used.
///   - Without GL, or with a software renderer, SIMD is used.
///   - If the pictures are too large for the GPU's textures, SIMD is used. Throws
///     Failure(Unavailable) if a step is configured to run on GLES.
///   - Otherwise, the engine that was faster on this GPU is used, measured now or at an earlier
///     start. If promisingEngines() returns only one choice, this choice is used and nothing is
///     measured.
[[nodiscard]] EngineChoice chooseEngines(const Config& config, const GlContext* gl,
                                         const StereoRig& rig, Size output);

}  // namespace mfar
