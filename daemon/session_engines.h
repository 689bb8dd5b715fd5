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

/// Opens GL, unless all steps run on SIMD and nothing else needs GL. Closes GL again if it is only
/// a software renderer, no step is configured to run on GLES, and nothing else needs GL. Throws
/// Failure if the configuration needs GLES and GL cannot be opened.
[[nodiscard]] OpenedGl openGl(const Config& config, GlDevice device);

/// Chooses the engine of each step: the configured one, if there is one. For "auto", SIMD is chosen
/// without GL and with a software renderer. Otherwise, the engine is chosen that was faster on this
/// GPU, measured now or at an earlier start. Nothing is measured if promisingEngines() returns only
/// one choice. If shader outputs are validated, "auto" means GLES.
[[nodiscard]] EngineChoice chooseEngines(const Config& config, const GlContext* gl,
                                         const StereoRig& rig, Size output);

}  // namespace mfar
