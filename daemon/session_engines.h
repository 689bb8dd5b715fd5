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
    std::string without;  ///< why there is none, in words; empty where none is needed
};

/// Opens GL unless every step runs on SIMD and nothing else draws with it; with engine "auto" a
/// software renderer is closed again. Throws Failure where the configuration needs GLES and there
/// is none.
[[nodiscard]] OpenedGl openGl(const Config& config, GlDevice device);

/// Chooses the engine of each step: as configured; for auto, SIMD without GL and on a software
/// renderer, otherwise the one that was measured to be faster on this GPU, now or at an earlier
/// start. With validation, which checks shaders, auto means GLES.
[[nodiscard]] EngineChoice chooseEngines(const Config& config, const GlContext* gl,
                                         const StereoRig& rig, Size output);

}  // namespace mfar
