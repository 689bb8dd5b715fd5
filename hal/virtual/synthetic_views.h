#pragma once

#include "hal/gl_context.h"
#include "hal/virtual/synthetic_renderer.h"
#include "hal/virtual/synthetic_studio.h"

#include <memory>

namespace mfar {

/// All objects of a SyntheticStudio that belong to its GL context. Only the studio's thread creates
/// and uses them.
struct SyntheticStudio::Views {
    Views(const SyntheticOptions& options, const synthetic::World& world, const StereoRig& rig);

    std::unique_ptr<GlContext> gl;
    synthetic::WorldGl shared;
    synthetic::SensorView video, still, highRes;
};

}  // namespace mfar
