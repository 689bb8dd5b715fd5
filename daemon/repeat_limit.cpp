#include "daemon/repeat_limit.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

namespace mfar {
namespace {

std::string times(std::uint64_t count, std::chrono::nanoseconds span) {
    const double s = std::chrono::duration<double>(span).count();
    return count == 1 ? fmt::format(" (repeated once in {:.0f} s)", s)
                      : fmt::format(" (repeated {} times in {:.0f} s)", count, s);
}

}  // namespace

bool RepeatLimit::mayPass(std::string_view event, const Message& message, Timestamp now) {
    auto found = events_.find(event);
    const bool isFull = events_.size() + 1 >= kMostEvents;
    if (found == events_.end() && isFull) found = events_.find("");
    if (found == events_.end()) {
        events_.emplace(isFull ? std::string() : std::string(event), Entry{now});
        return true;
    }
    Entry& entry = found->second;
    if (entry.kept == 0 && now - entry.said >= kInterval) {
        entry.said = now;
        return true;
    }
    ++entry.kept;
    entry.last = now;
    entry.newest = message;
    return false;
}

std::vector<RepeatLimit::Message> RepeatLimit::due(Timestamp now) {
    return take(now, false);
}

std::vector<RepeatLimit::Message> RepeatLimit::rest(Timestamp now) {
    return take(now, true);
}

std::vector<RepeatLimit::Message> RepeatLimit::take(Timestamp now, bool all) {
    std::multimap<Timestamp, Message> found;  // sorted by time, then by the event's name
    for (auto one = events_.begin(); one != events_.end();) {
        Entry& entry = one->second;
        const bool isOver = all || now - entry.said >= kInterval;
        if (isOver && entry.kept == 0) {
            one = events_.erase(one);
            continue;
        }
        if (isOver) {
            entry.newest.text += times(entry.kept, now - entry.said);
            entry.newest.count = entry.kept;
            found.emplace(entry.last, std::move(entry.newest));
            entry = Entry{now};
        }
        ++one;
    }
    std::vector<Message> out;
    out.reserve(found.size());
    for (auto& [last, message] : found)
        out.push_back(std::move(message));
    return out;
}

}  // namespace mfar
