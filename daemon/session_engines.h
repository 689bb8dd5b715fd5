#pragma once

#include "daemon/config.h"
#include "hal/gl_context.h"
#include "pipeline/engine/engine.h"

#include <memory>
#include <string>

namespace mfar {

/// GL as far as a session needs it.
struct OpenedGl {
    std::unique_ptr<GlContext> context;  ///< current on this thread; null: none is used
    std::string without;  ///< why there is none: for people; empty where none is needed
};

/// Opens GL unless every step runs on SIMD and nothing else draws with it: with engine "auto" a
/// software renderer is given back. Throws Failure where the configuration needs GLES and there is
/// none.
[[nodiscard]] OpenedGl openGl(const Config& config, GlDevice device);

/// Which engine does which step: as configured; where that leaves it open, SIMD without GL and on a
/// software renderer, else what was measured to be faster on this GPU, now or at an earlier start.
/// Validation is of shaders: with it, GLES.
[[nodiscard]] EngineChoice chooseEngines(const Config& config, const GlContext* gl,
                                         const StereoRig& rig, Size output);

}  // namespace mfar
