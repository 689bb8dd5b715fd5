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

/// Checks that the GPU finishes pictures and has lost nothing. Lives on the thread of the context.
///
/// The wait for a GPU is limited to half a second. A software renderer may take longer, but its
/// thread does not wait longer than half a second at a time, either.
class GpuWatch {
public:
    /// `context` may be null, now or later; then nothing is checked. It must outlive this.
    explicit GpuWatch(const std::unique_ptr<GlContext>& context) : context_(context) {}

    /// To be called before each picture. Waits, half a second at most, while the GPU has not
    /// finished the third last picture, or has worked on one for half a second. False when a
    /// software renderer has still not finished: nothing may be drawn then. Throws GpuLost.
    [[nodiscard]] bool isReady();
    /// Throws GpuLost when what was drawn so far may be wrong.
    void requireSound() const;
    /// To be called after the commands of a picture, before the display's. Throws GpuLost when the
    /// commands failed.
    void drawn();
    /// The reason why everything on the GPU has to be created again after `error`; nothing when the
    /// GPU did not cause the error.
    [[nodiscard]] std::optional<std::string> lossBehind(const std::exception& error) const;
    /// In words; nothing without a fault.
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
