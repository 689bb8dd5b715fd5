#pragma once

#include "base/gl/validation.h"
#include "hal/gl_context.h"
#include "tests/stability/checks.h"

#include <map>
#include <memory>
#include <string>

namespace mfar::stress {

/// Watches the GL's passes: their outputs (gpu::Validation), the bytes behind their buffers, and
/// each index into a buffer, a texture or an image (watched_shaders.h). Makes the context.
class GlWatch {
public:
    GlWatch();
    ~GlWatch();
    GlWatch(const GlWatch&) = delete;
    GlWatch& operator=(const GlWatch&) = delete;

    /// All passes since the last call worked on pictures of so many pixels, or on as many as they
    /// wrote where those are more; what is wrong with them is a fault.
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
