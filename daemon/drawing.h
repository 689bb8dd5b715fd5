#pragma once

#include "base/gl/validation.h"
#include "daemon/banner.h"
#include "daemon/config.h"
#include "daemon/gpu_watch.h"
#include "daemon/tracing_watch.h"
#include "daemon/virtual_world.h"
#include "hal/gl_context.h"
#include "hal/picture.h"
#include "pipeline/pipeline.h"

#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// All objects that make pictures, except the display. They work with or without a GL context. If
/// there is a GL context, it must be current while a Drawing is created, used or destroyed. After a
/// loss of the GL context, a new Drawing must be created.
struct Drawing {
    /// The pointer `gl` must outlive this object. It may be null if GL is not used. The caller may
    /// create the GL context later, if only previews of virtual objects need it. Throws GlError,
    /// and Failure like chooseEngines().
    Drawing(const Config& config, const StereoRig& rig, Size output,
            const std::unique_ptr<GlContext>& gl);

    GpuWatch gpu;
    /// Checks the outputs of all passes; null: no checks.
    std::unique_ptr<gpu::Validation> validation;
    EngineChoice engines;
    Pipeline pipeline;
    VirtualWorld objects;
    TracingWatch tracing;
    Banner banner;
    Picture last;  ///< the pipeline's last picture, without banner; may be empty
    std::optional<Picture> shown;
    std::string faultShown;  ///< text of the banner on `shown`; empty: no banner
};

}  // namespace mfar
