#pragma once

#include "base/gl/fence.h"
#include "base/time.h"
#include "hal/gl_context.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// Looks whether the GPU gets done with the pictures. Lives on the thread of the context.
///
/// A GPU that does not is waited for half a second at a time, so that its thread goes on; after
/// five seconds, or as soon as the context is lost, only a new process helps. A software renderer
/// may be as slow as it likes.
class GpuWatch {
public:
    static constexpr std::chrono::seconds kGivenUp{5};

    /// `context` may be null, now or later, and then there is nothing to watch. It must outlive
    /// this.
    explicit GpuWatch(const std::unique_ptr<GlContext>& context) : context_(context) {}

    /// To be asked before each picture; waits where the GPU has not done the third last one, or one
    /// for half a second. False: it still has not, and nothing may be drawn. Throws Failure where
    /// only a new process helps.
    [[nodiscard]] bool isReady();
    /// After the commands of a picture, before the display's.
    void drawn();
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
