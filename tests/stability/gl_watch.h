#pragma once

#include "base/gl/validation.h"
#include "hal/gl_context.h"
#include "tests/stability/checks.h"

#include <map>
#include <memory>
#include <string>

namespace mfar::stress {

/// Checks all GL passes: gpu::Validation checks their outputs and the guard bytes behind their
/// buffers; watched_shaders.h checks every index into a buffer, a texture or an image. The
/// constructor creates the GL context.
class GlWatch {
public:
    GlWatch();
    ~GlWatch();
    GlWatch(const GlWatch&) = delete;
    GlWatch& operator=(const GlWatch&) = delete;

    /// Must be called after each frame. `pixels`: number of pixels that each pass of the frame
    /// processes. For every pass that ran since the last call, adds `pixels` to the pass's count in
    /// `checks`, or the number of pixels that the pass wrote if that is larger. Adds the faults of
    /// these passes to `checks`.
    void frame(Checks& checks, long pixels);

private:
    std::unique_ptr<GlContext> context_;
    gpu::Validation validation_;
    GLuint outOfRange_ = 0;
    struct Counted {
        long runs = 0, pixels = 0;
    };
    std::map<std::string, Counted> counted_;
};

}  // namespace mfar::stress
