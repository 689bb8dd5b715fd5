#pragma once

#include "base/gl/gl.h"

#include <chrono>
#include <utility>

namespace mfar::gpu {

/// A working GPU never needs this long: the kernel resets it earlier.
inline constexpr std::chrono::milliseconds kLongestGpuWait{500};

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

    /// True when the GPU has passed the fence. Waits at most `limit`. Always false once the context
    /// is lost.
    [[nodiscard]] bool passed(std::chrono::nanoseconds limit = std::chrono::nanoseconds{0}) const {
        const GLenum status = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT,
                                               static_cast<GLuint64>(limit.count()));
        return status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
    }

private:
    GLsync sync_;
};

/// As glFinish(), but bounded: false when the GPU hangs or the context is lost.
[[nodiscard]] inline bool finishWithin(std::chrono::nanoseconds limit = kLongestGpuWait) {
    return Fence().passed(limit);
}

}  // namespace mfar::gpu
