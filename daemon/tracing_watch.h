#pragma once

#include "base/time.h"
#include "pipeline/traced_layer.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace mfar {

/// Notices that virtual objects are in view, but that the path tracer finishes no picture of them.
/// Until the first picture is finished, the objects are not shown at all. Usually the cause is
/// other load, because the path tracer runs at low priority. Only one thread may use it.
class TracingWatch {
public:
    /// The user is warned if objects are in view for this long without a picture.
    static constexpr std::chrono::seconds kPatience{5};

    /// `budgetMs`: TracedRendererOptions::budgetMs. Until the first picture is shown, the path
    /// tracer may use twice this time per frame.
    explicit TracingWatch(double budgetMs) : budgetMs_(budgetMs) {}

    /// Must be called after each frame. `inView`: objects are in view, and not all of them are
    /// hidden. Returns a warning, at most once.
    [[nodiscard]] std::optional<std::string> add(bool inView, const RenderCounters& counters,
                                                 Timestamp frame);
    /// Must be called after the last frame. Returns a warning if objects were in view but never
    /// shown, unless add() has returned it.
    [[nodiscard]] std::optional<std::string> atEnd();

private:
    struct Wait {
        Timestamp since;
        double cpuMs = 0;  ///< RenderCounters::cpuMs at `since`
    };

    double budgetMs_;
    std::optional<Wait> wait_;
    std::uint64_t frames_ = 0;  ///< number of frames with `inView` since wait_->since
    double usedMs_ = 0;
    bool done_ = false;  ///< true: there was a picture or a warning
};

}  // namespace mfar
