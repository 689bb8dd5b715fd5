#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace mfar {

/// Finds faults of the trigger line that were not logged yet. Only one thread may use it.
class TriggerReports {
public:
    struct Seen {
        std::uint64_t lost = 0;
        std::uint64_t missedEdges = 0;
        bool repeats = false;  ///< true: the lost still is requested again
    };
    /// Returns one sentence for each type of fault (lost stills, missed edges) that has occurred
    /// since the last call. Allocates memory only if there is such a fault.
    [[nodiscard]] std::vector<std::string_view> newSince(const Seen& seen);

private:
    Seen reported_;
};

}  // namespace mfar
