#pragma once

#include "hal/gl_context.h"
#include "hal/virtual/synthetic_renderer.h"
#include "hal/virtual/synthetic_studio.h"

#include <memory>

namespace mfar {

/// Everything of a studio that lives in its GL context; made and used on its thread alone.
struct SyntheticStudio::Views {
    Views(const SyntheticOptions& options, const synthetic::World& world, const StereoRig& rig);

    std::unique_ptr<GlContext> gl;
    synthetic::WorldGl shared;
    synthetic::SensorView video, still, highRes;
};

}  // namespace mfar
