#include "daemon/trigger_reports.h"

namespace mfar {

std::vector<std::string_view> TriggerReports::newSince(const Seen& seen) {
    std::vector<std::string_view> out;
    if (seen.lost > reported_.lost)
        out.push_back(seen.repeats
                          ? "no still arrived after a trigger pulse; the still is requested again"
                          : "no still arrived after a trigger pulse");
    if (seen.missedEdges > reported_.missedEdges)
        out.push_back("the loopback input missed an edge of a trigger pulse, so the time of the "
                      "still's exposure was not measured");
    reported_ = seen;
    return out;
}

}  // namespace mfar
