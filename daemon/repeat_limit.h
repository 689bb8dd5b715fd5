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

/// Limits repeated messages, so that a loose plug cannot fill the disk with them. The first message
/// about an event passes at once. While the event repeats, one message about it passes every ten
/// seconds, with the number of repetitions. The last message about an event always passes. To limit
/// the memory, at most 63 events at a time are told apart; all others count as one event. Only one
/// thread at a time may use it.
class RepeatLimit {
public:
    static constexpr std::chrono::seconds kInterval{10};
    static constexpr std::size_t kMostEvents = 64;

    struct Message {
        int priority = 0;
        std::string text;
        std::string_view word{};
        Subject subject{};
        std::uint64_t count = 1;
    };

    /// Returns true if the message must be logged now. Otherwise keeps it for due() or rest(),
    /// instead of an older message about the same event.
    [[nodiscard]] bool mayPass(std::string_view event, const Message& message, Timestamp now);
    /// Returns the kept messages that may be logged now, in the order of their last events. Each
    /// ends with the number of repetitions: "... (repeated 7 times in 28 s)".
    [[nodiscard]] std::vector<Message> due(Timestamp now);
    /// Like due(), but returns all kept messages.
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
