#pragma once

#include <string>
#include <vector>

namespace mfar {

/// Sends a message to the journal of systemd: fields as "NAME=value", see sd_journal_sendv(3).
/// Waits half a second for room at most. False when there is no journal or it takes nothing.
[[nodiscard]] bool sendToJournal(const std::vector<std::string>& fields);

}  // namespace mfar
