#include "daemon/tracing_watch.h"

#include <fmt/format.h>

#include <utility>

namespace mfar {

std::optional<std::string> TracingWatch::add(bool inView, const RenderCounters& counters,
                                             Timestamp frame) {
    if (counters.shown > 0) done_ = true;
    if (done_) return {};
    if (!inView) {
        wait_.reset();
        return {};
    }
    // A new path tracer counts from 0 again.
    if (!wait_ || counters.cpuMs < wait_->cpuMs) {
        wait_ = Wait{frame, counters.cpuMs};
        frames_ = 0;
    }
    ++frames_;
    usedMs_ = counters.cpuMs - wait_->cpuMs;
    if (frame - wait_->since < kPatience) return {};
    return atEnd();
}

std::optional<std::string> TracingWatch::atEnd() {
    if (std::exchange(done_, true) || frames_ == 0) return {};
    return fmt::format("virtual objects were in view in {} frames but are not shown, because the "
                       "path tracer has no picture of them yet; it got {:.0f} of {:.0f} ms of "
                       "processor time (its priority is low, so other load delays it)",
                       frames_, usedMs_, 2 * budgetMs_ * static_cast<double>(frames_));
}

}  // namespace mfar
