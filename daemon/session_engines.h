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
    std::string without;  ///< why GL could not be opened; empty: it is open or not needed
};

/// Opens GL, unless all steps run on SIMD and nothing else needs GL. If the configured engine is
/// "auto" and GL turns out to be a software renderer, GL is closed again. Throws Failure if the
/// configuration needs GLES and GL cannot be opened.
[[nodiscard]] OpenedGl openGl(const Config& config, GlDevice device);

/// Chooses the engine of each step. If an engine is configured for the step, that one is used. For
/// "auto", SIMD is used if there is no GL or only a software renderer. Otherwise the engine is used
/// that was measured to be the faster one on this GPU, now or at an earlier start. If the outputs
/// of shaders are validated, "auto" means GLES.
[[nodiscard]] EngineChoice chooseEngines(const Config& config, const GlContext* gl,
                                         const StereoRig& rig, Size output);

}  // namespace mfar
