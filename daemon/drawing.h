#pragma once

#include "base/gl/validation.h"
#include "daemon/banner.h"
#include "daemon/config.h"
#include "daemon/gpu_watch.h"
#include "daemon/virtual_world.h"
#include "hal/gl_context.h"
#include "hal/picture.h"
#include "pipeline/pipeline.h"

#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// Everything that draws on one GL context, or without one, except for the display's own objects.
/// It is lost with the context. Created, used and destroyed with that context current.
struct Drawing {
    /// `gl`: null, now or later, where nothing is drawn with GL; must outlive this. Throws GlError.
    Drawing(const Config& config, const StereoRig& rig, Size output,
            const std::unique_ptr<GlContext>& gl);

    GpuWatch gpu;
    std::unique_ptr<gpu::Validation> validation;  ///< of everything that the pipeline writes
    EngineChoice engines;
    Pipeline pipeline;
    VirtualWorld objects;
    Banner banner;
    Picture last;  ///< the pipeline's last picture, without banner; empty before the first
    std::optional<Picture> shown;  ///< the last picture that the display got
    std::string faultShown;        ///< text of the banner on it
};

}  // namespace mfar
