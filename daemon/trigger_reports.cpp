#include "daemon/trigger_reports.h"

namespace mfar {

std::vector<std::string_view> TriggerReports::newSince(const Seen& seen) {
    std::vector<std::string_view> out;
    if (seen.lost > reported_.lost)
        out.push_back(seen.repeats ? "no still arrived after a pulse; it is requested again"
                                   : "no still arrived after a pulse");
    if (seen.missedEdges > reported_.missedEdges)
        out.push_back("the loopback input missed an edge of a pulse, so the time of the exposure "
                      "is unverified");
    reported_ = seen;
    return out;
}

}  // namespace mfar
