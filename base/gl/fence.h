#pragma once

#include "base/gl/gl.h"

#include <chrono>
#include <utility>

namespace mfar::gpu {

/// Longest wait for the GPU. A GPU that does not finish in this time counts as hanging. mfar needs
/// a limit of its own, because the time after which the kernel resets a blocked GPU depends on the
/// driver.
inline constexpr std::chrono::milliseconds kLongestGpuWait{500};

/// Marks a point in the stream of GL commands. Move-only.
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

    /// Waits at most `limit`. Returns true if the GPU has executed all commands before the fence.
    /// Returns false if it has not or if the context is lost.
    [[nodiscard]] bool passed(std::chrono::nanoseconds limit = std::chrono::nanoseconds{0}) const {
        const GLenum status = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT,
                                               static_cast<GLuint64>(limit.count()));
        return status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
    }

private:
    GLsync sync_;
};

/// Waits like glFinish(), but at most `limit`. Returns false if the GPU did not finish in that time
/// or if the context is lost.
[[nodiscard]] inline bool finishWithin(std::chrono::nanoseconds limit = kLongestGpuWait) {
    return Fence().passed(limit);
}

}  // namespace mfar::gpu
