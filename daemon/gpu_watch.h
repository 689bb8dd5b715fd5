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

/// Looks whether the GPU gets done with the pictures and has lost nothing. Lives on the thread of
/// the context.
///
/// A GPU is waited for half a second. A software renderer may be as slow as it likes, but its
/// thread goes on every half a second, too.
class GpuWatch {
public:
    /// `context` may be null, now or later, and then there is nothing to watch. It must outlive
    /// this.
    explicit GpuWatch(const std::unique_ptr<GlContext>& context) : context_(context) {}

    /// To be asked before each picture; waits where the GPU has not done the third last one, or one
    /// for half a second. False: a software renderer still has not, and nothing may be drawn.
    /// Throws GpuLost.
    [[nodiscard]] bool isReady();
    /// Throws GpuLost where what was drawn so far cannot be trusted.
    void requireSound() const;
    /// After the commands of a picture, before the display's. Throws GpuLost where they failed.
    void drawn();
    /// Why all on the GPU has to be made anew after `error`; nothing where that is another's fault.
    [[nodiscard]] std::optional<std::string> lossBehind(const std::exception& error) const;
    /// For people, nothing when all is well.
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
