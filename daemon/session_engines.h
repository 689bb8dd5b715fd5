#pragma once

#include "daemon/config.h"
#include "hal/gl_context.h"
#include "pipeline/engine/engine.h"

#include <memory>
#include <string>

namespace mfar {

/// The GL context of a session, if it needs one.
struct OpenedGl {
    std::unique_ptr<GlContext> context;  ///< current on this thread; null: GL is not used
    std::string without;  ///< why GL could not be opened; empty: it was opened or is not needed
};

/// Opens GL, unless all steps run on SIMD and nothing else needs GL. If the engine is "auto" and
/// the renderer is a software renderer, GL is closed again. Throws Failure if the configuration
/// needs GLES and GL cannot be opened.
[[nodiscard]] OpenedGl openGl(const Config& config, GlDevice device);

/// Chooses the engine of each step. A configured engine is used. For "auto", SIMD is used if there
/// is no GL or only a software renderer. Otherwise the engine is used that was measured to be
/// faster on this GPU, now or at an earlier start. With validation, which checks shaders, "auto"
/// means GLES.
[[nodiscard]] EngineChoice chooseEngines(const Config& config, const GlContext* gl,
                                         const StereoRig& rig, Size output);

}  // namespace mfar
