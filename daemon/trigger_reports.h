#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace mfar {

/// Finds what went wrong at the trigger line since the last look, for the log. Used by one thread.
class TriggerReports {
public:
    struct Seen {
        std::uint64_t lost = 0;         ///< pulses without a still
        std::uint64_t missedEdges = 0;  ///< pulses of which the loopback missed an edge
        bool repeats = false;           ///< a lost still is asked for once more
    };
    /// One sentence for each kind of event that is new. Allocates only then.
    [[nodiscard]] std::vector<std::string_view> newSince(const Seen& seen);

private:
    Seen reported_;
};

}  // namespace mfar
