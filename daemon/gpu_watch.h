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
/// The wait for a GPU is limited to half a second; then the GPU counts as lost. A software renderer
/// may take longer, but a single wait for it is limited to half a second, too.
class GpuWatch {
public:
    /// `context` must outlive this object. While it is null, nothing is checked.
    explicit GpuWatch(const std::unique_ptr<GlContext>& context) : context_(context) {}

    /// Must be called before each picture. Waits, half a second at most, if the GPU has three
    /// unfinished pictures or has worked on one for half a second. Returns false if a software
    /// renderer has not finished then; nothing may be drawn. Throws GpuLost.
    [[nodiscard]] bool isReady();
    /// Throws GpuLost if the pictures drawn so far may be wrong.
    void requireSound() const;
    /// Must be called after the GL commands of a picture, before those of the display. Throws
    /// GpuLost if the commands failed.
    void drawn();
    /// Returns why all objects on the GPU must be created again after `error`. Returns nothing if
    /// the GPU did not cause the error.
    [[nodiscard]] std::optional<std::string> lossBehind(const std::exception& error) const;
    /// Returns a message about the fault, or nothing.
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
