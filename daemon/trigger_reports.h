#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace mfar {

/// Finds new faults of the trigger line for the log. Used by one thread.
class TriggerReports {
public:
    struct Seen {
        std::uint64_t lost = 0;         ///< pulses without a still
        std::uint64_t missedEdges = 0;  ///< pulses with an edge that the loopback missed
        bool repeats = false;           ///< a lost still is requested again
    };
    /// One sentence for each kind of event that is new since the last call. Allocates only then.
    [[nodiscard]] std::vector<std::string_view> newSince(const Seen& seen);

private:
    Seen reported_;
};

}  // namespace mfar
