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

/// All objects that make pictures, with a GL context or without one. The display's objects are not
/// included. If there is a context, it must be current when this is created, used and destroyed. If
/// the context is lost, this must be created again.
struct Drawing {
    /// `gl` must outlive this object. It may be null, or become null, if GL is not used. Throws
    /// GlError.
    Drawing(const Config& config, const StereoRig& rig, Size output,
            const std::unique_ptr<GlContext>& gl);

    GpuWatch gpu;
    std::unique_ptr<gpu::Validation> validation;  ///< checks all outputs of passes; null: it is off
    EngineChoice engines;
    Pipeline pipeline;
    VirtualWorld objects;
    Banner banner;
    Picture last;  ///< the pipeline's last picture, without banner; empty before the first
    std::optional<Picture> shown;  ///< the last picture that the display got
    std::string faultShown;        ///< text of the banner on `shown`; empty: no banner
};

}  // namespace mfar
