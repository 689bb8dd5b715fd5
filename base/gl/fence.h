#pragma once

#include "base/gl/gl.h"

#include <utility>

namespace mfar::gpu {

/// A point in the stream of GL commands. Move-only.
class Fence {
public:
    Fence() : sync_(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {}
    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        std::swap(sync_, other.sync_);
        return *this;
    }
    Fence(const Fence&) = delete;
    Fence& operator=(const Fence&) = delete;
    ~Fence() {
        if (sync_ != nullptr) glDeleteSync(sync_);
    }

    /// Whether the GPU is past it. Does not wait.
    [[nodiscard]] bool passed() const {
        const GLenum status = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
        return status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
    }

private:
    GLsync sync_;
};

}  // namespace mfar::gpu
