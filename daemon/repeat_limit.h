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

/// Limits repeated messages: an event's first message passes at once, then each event passes at
/// most once in ten seconds, with the number of repetitions. A loose plug cannot fill the disk, and
/// the last message of an event always passes. Bounded memory: beyond 64 events at a time, all
/// others are treated as one. Used by one thread at a time.
class RepeatLimit {
public:
    static constexpr std::chrono::seconds kInterval{10};
    static constexpr std::size_t kMostEvents = 64;

    struct Message {
        int priority = 0;
        std::string text;
        std::string_view word{};  ///< prefix of each line: "warning: "; must outlive this
        Subject subject{};
        std::uint64_t count = 1;  ///< number of events that the message stands for
    };

    /// True: log it now. Otherwise it is held back and replaces an earlier message of its event.
    [[nodiscard]] bool mayPass(std::string_view event, const Message& message, Timestamp now);
    /// The messages that were held back and may be logged now, sorted by the time of their last
    /// event, each with its count: "... (7 more times in 28 s)".
    [[nodiscard]] std::vector<Message> due(Timestamp now);
    /// All messages that were held back, for the end of the log.
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
