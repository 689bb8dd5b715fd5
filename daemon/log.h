#pragma once

#include "base/time.h"
#include "daemon/repeat_limit.h"

#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Messages for people on standard error. One that nobody takes within half a second is dropped,
/// and the next one says so: no thread hangs for its messages. On a terminal the last line may be a
/// status line, which is redrawn in place. Under systemd messages go to its journal, with fields
/// (MESSAGE_ID, MFAR_CAMERA, MFAR_THREAD, MFAR_COUNT: see message_ids.h; the last is how many
/// events the message stands for), or where that takes none, to standard error with a "<priority>"
/// prefix. Thread-safe.
class Log {
public:
    enum class Style { Terminal, Journal, Plain };

    /// Style of standard error as it is now (JOURNAL_STREAM names the journal's socket).
    [[nodiscard]] static Style styleOf(int fd);

    using Clock = std::function<Timestamp()>;
    /// Takes the fields of a message, "NAME=value"; false: it cannot.
    using Send = std::function<bool(const std::vector<std::string>& fields)>;
    /// `send`: with Style::Journal, empty for none.
    Log(int fd, Style style, Clock clock = &Timestamp::now, Send send = {})
        : fd_(fd), style_(style), clock_(std::move(clock)), send_(std::move(send)) {}

    void error(std::string_view text, const Subject& subject = {}) {
        line(3, "error: ", text, subject);
    }
    /// What may come again and again, as devices do: each event at most once in ten seconds, see
    /// RepeatLimit. Texts of one event that differ, for instance in a number, name it.
    void warning(std::string_view text, std::string_view event = {}, const Subject& subject = {}) {
        limited(4, "warning: ", text, event, subject);
    }
    /// The same where nothing is wrong.
    void change(std::string_view text, std::string_view event = {}, const Subject& subject = {}) {
        limited(5, "", text, event, subject);
    }
    /// What happens once or on demand: start, reload.
    void notice(std::string_view text, const Subject& subject = {}) { line(5, "", text, subject); }
    /// Says what was kept back and may be said by now; to be called now and then.
    void sayKept();

    /// Replaces the status line; nothing happens where there is no terminal.
    void status(std::string_view text);
    /// Leaves the status line as it is, says what was kept back and goes on below it.
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
    std::string status_;  ///< shown now, without line end
};

}  // namespace mfar
