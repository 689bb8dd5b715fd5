#pragma once

#include "base/time.h"
#include "daemon/message_ids.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Decides which messages of events that come again and again are said: the first at once, then
/// each event once in ten seconds at most, with how often it has come since. A plug that is loose
/// for a day fills no disk, and the last message of an event is always said. Bounded memory: past
/// 64 events at a time, all others count as one. Used by one thread at a time.
class RepeatLimit {
public:
    static constexpr std::chrono::seconds kInterval{10};
    static constexpr std::size_t kMostEvents = 64;

    struct Message {
        int priority = 0;
        std::string text;
        std::string_view word{};  ///< before each line: "warning: "; outlives this
        Subject subject{};
        std::uint64_t count = 1;  ///< events that it stands for
    };

    /// True: to be said now. Else it is kept, in place of an earlier one of its event.
    [[nodiscard]] bool mayPass(std::string_view event, const Message& message, Timestamp now);
    /// What was kept and may be said now, in the order of the last time, each with its count:
    /// "... (7 more times in 28 s)".
    [[nodiscard]] std::vector<Message> due(Timestamp now);
    /// All that was kept, as nothing will follow.
    [[nodiscard]] std::vector<Message> rest(Timestamp now);

private:
    struct Entry {
        Timestamp said;
        Timestamp last{};
        std::uint64_t kept = 0;
        Message newest{};
    };
    [[nodiscard]] std::vector<Message> take(Timestamp now, bool all);

    std::map<std::string, Entry, std::less<>> events_;
};

}  // namespace mfar
