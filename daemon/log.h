#pragma once

#include "base/time.h"
#include "daemon/repeat_limit.h"

#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Messages on standard error. A message that cannot be written within half a second is dropped,
/// and the next one reports the drop: no thread hangs because of its messages. On a terminal the
/// last line may be a status line, which is redrawn in place. Under systemd messages go to its
/// journal, with fields (MESSAGE_ID, MFAR_CAMERA, MFAR_THREAD, MFAR_COUNT: see message_ids.h; the
/// last is the number of events that the message stands for). When the journal is full they go to
/// standard error with a "<priority>" prefix. Thread-safe.
class Log {
public:
    enum class Style { Terminal, Journal, Plain };

    /// The style for standard error as it is now (JOURNAL_STREAM names the journal's socket).
    [[nodiscard]] static Style styleOf(int fd);

    using Clock = std::function<Timestamp()>;
    /// Sends the fields of a message, "NAME=value"; false on failure.
    using Send = std::function<bool(const std::vector<std::string>& fields)>;
    /// `send`: for Style::Journal; empty: no journal.
    Log(int fd, Style style, Clock clock = &Timestamp::now, Send send = {})
        : fd_(fd), style_(style), clock_(std::move(clock)), send_(std::move(send)) {}

    void error(std::string_view text, const Subject& subject = {}) {
        line(3, "error: ", text, subject);
    }
    /// For events that can repeat, as those of devices: each event is logged at most once in ten
    /// seconds, see RepeatLimit. `event` names the event where its texts differ, for instance in a
    /// number.
    void warning(std::string_view text, std::string_view event = {}, const Subject& subject = {}) {
        limited(4, "warning: ", text, event, subject);
    }
    /// The same for changes that are no fault.
    void change(std::string_view text, std::string_view event = {}, const Subject& subject = {}) {
        limited(5, "", text, event, subject);
    }
    /// For messages that come once or on demand: start, reload.
    void notice(std::string_view text, const Subject& subject = {}) { line(5, "", text, subject); }
    /// Logs the messages that were held back and are due; to be called regularly.
    void sayKept();

    /// Replaces the status line; does nothing without a terminal.
    void status(std::string_view text);
    /// Ends the status line with a line break and logs the messages that were held back.
    void endStatus();

    [[nodiscard]] Style style() const { return style_; }

private:
    void limited(int priority, std::string_view word, std::string_view text, std::string_view event,
                 const Subject& subject);
    void line(int priority, std::string_view word, std::string_view text, const Subject& subject);
    void say(const RepeatLimit::Message& message);
    void put(std::string_view bytes);
    [[nodiscard]] bool isWritable();

    const int fd_;
    const Style style_;
    const Clock clock_;
    const Send send_;
    std::mutex mutex_;
    RepeatLimit limit_;
    int dropped_ = 0;     ///< messages since the last one that was written
    std::string status_;  ///< visible now, without line end
};

}  // namespace mfar
