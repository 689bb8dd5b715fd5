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
/// If the GPU does not finish a picture during a wait of half a second, it counts as lost. A
/// software renderer never counts as lost for this reason, but each wait for it is limited to half
/// a second, too.
class GpuWatch {
public:
    /// `context` must outlive this object. While its pointer is null, nothing is checked.
    explicit GpuWatch(const std::unique_ptr<GlContext>& context) : context_(context) {}

    /// Must be called before each picture. If the GPU has three unfinished pictures, or one that is
    /// older than half a second, waits at most half a second for the oldest of them. Throws GpuLost
    /// if the GPU was lost, or if it has not finished that picture after the wait. A software
    /// renderer may take longer: then this function returns false, and nothing may be drawn.
    [[nodiscard]] bool isReady();
    /// Throws GpuLost if the pictures drawn so far may be wrong.
    void requireSound() const;
    /// Must be called after the GL commands of a picture and before those of the display. Throws
    /// GpuLost if the picture's commands failed.
    void drawn();
    /// Returns the reason of the loss if a lost GPU caused `error`, otherwise nothing. After a
    /// loss, all objects on the GPU must be created again.
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
