#pragma once

#include "base/time.h"
#include "daemon/repeat_limit.h"

#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Writes messages to standard error. A message that cannot be written within half a second is
/// dropped, so that no thread hangs because of its messages. The next message reports the number of
/// dropped ones. On a terminal, the last line may be a status line, which is redrawn in place.
/// Thread-safe.
///
/// Under systemd, messages go to the journal, with the fields MESSAGE_ID, MFAR_CAMERA, MFAR_THREAD
/// (see message_ids.h) and MFAR_COUNT (number of events that the message reports). If the journal
/// is full, they go to standard error with a prefix "<priority>".
class Log {
public:
    enum class Style { Terminal, Journal, Plain };

    /// Returns Terminal if the descriptor is a terminal, Journal if the environment variable
    /// JOURNAL_STREAM names the descriptor's file, and Plain otherwise.
    [[nodiscard]] static Style styleOf(int fd);

    using Clock = std::function<Timestamp()>;
    using Send = std::function<bool(const std::vector<std::string>& fields)>;
    /// `send` is used for Style::Journal. It may be empty.
    Log(int fd, Style style, Clock clock = &Timestamp::now, Send send = {})
        : fd_(fd), style_(style), clock_(std::move(clock)), send_(std::move(send)) {}

    void error(std::string_view text, const Subject& subject = {}) {
        line(3, "error: ", text, subject);
    }
    /// Logs an event that may repeat, such as a fault of a device. Each event is logged at most
    /// once in ten seconds, see RepeatLimit. `event` identifies the event. It is needed if the
    /// messages about one event differ, e.g. in a number. If `event` is empty, the text identifies
    /// the event.
    void warning(std::string_view text, std::string_view event = {}, const Subject& subject = {}) {
        limited(4, "warning: ", text, event, subject);
    }
    /// Logs a change that is not a fault. Each change is logged at most once in ten seconds.
    void change(std::string_view text, std::string_view event = {}, const Subject& subject = {}) {
        limited(5, "", text, event, subject);
    }
    /// Logs a message that comes only once or that a user requested, e.g. the answer to a reload.
    void notice(std::string_view text, const Subject& subject = {}) { line(5, "", text, subject); }
    /// Logs the messages that RepeatLimit has delayed and now releases. Must be called regularly.
    void sayKept();

    /// Replaces the status line. Does nothing without a terminal.
    void status(std::string_view text);
    /// Logs all delayed messages and ends the status line with a line break.
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
    int dropped_ = 0;
    std::string status_;
};

}  // namespace mfar
