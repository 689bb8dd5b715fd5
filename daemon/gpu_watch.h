#pragma once

#include "base/gl/fence.h"
#include "base/time.h"
#include "hal/gl_context.h"

#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// Checks that the GPU finishes its pictures and was not reset. Only the GL context's thread may
/// use it.
///
/// A GPU that does not finish within half a second counts as lost. A software renderer may take
/// longer and does not count as lost, but each single wait for it is limited to half a second, too.
class GpuWatch {
public:
    /// `context` must outlive this object. While its pointer is null, nothing is checked.
    explicit GpuWatch(const std::unique_ptr<GlContext>& context) : context_(context) {}

    /// Must be called before each picture. If the GPU has three unfinished pictures, or has worked
    /// on one for half a second, waits at most half a second. Throws GpuLost if the GPU was lost or
    /// has still not finished the oldest picture. Returns false if a software renderer has not
    /// finished that picture; then nothing may be drawn.
    [[nodiscard]] bool isReady();
    /// Throws GpuLost if the pictures drawn so far may be wrong.
    void requireSound() const;
    /// Must be called after a picture's GL commands and before the display's GL commands. Throws
    /// GpuLost if the picture's commands failed.
    void drawn();
    /// If a lost GPU caused `error`, returns the reason of the loss. All objects on the GPU must
    /// then be created again. Otherwise returns nothing.
    [[nodiscard]] std::optional<std::string> lossBehind(const std::exception& error) const;
    [[nodiscard]] std::optional<std::string> fault() const;

private:
    [[nodiscard]] bool isOldestDue() const;

    struct Drawn {
        gpu::Fence fence;
        Timestamp since;
    };

    const std::unique_ptr<GlContext>& context_;
    std::deque<Drawn> inWork_;
    bool isLate_ = false;
};

}  // namespace mfar
