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

/// Limits repeated messages, so that a loose plug cannot fill the disk. The first message of an
/// event passes at once. After that, one message of the event passes in ten seconds, with the
/// number of repetitions. The last message of an event always passes. To limit the memory, all
/// events beyond 64 at a time are treated as one. Only one thread at a time may use it.
class RepeatLimit {
public:
    static constexpr std::chrono::seconds kInterval{10};
    static constexpr std::size_t kMostEvents = 64;

    struct Message {
        int priority = 0;
        std::string text;
        std::string_view word{};  ///< prefix, e.g. "warning: "; must outlive this object
        Subject subject{};
        std::uint64_t count = 1;  ///< number of events that the message reports
    };

    /// Returns whether the message must be logged now. If not, it is kept and replaces the kept
    /// message of the same event.
    [[nodiscard]] bool mayPass(std::string_view event, const Message& message, Timestamp now);
    /// Returns the kept messages that may be logged now, sorted by the time of their last event.
    /// Each has the number of its repetitions: "... (7 more times in 28 s)".
    [[nodiscard]] std::vector<Message> due(Timestamp now);
    /// Returns all kept messages, for the end of the log.
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
