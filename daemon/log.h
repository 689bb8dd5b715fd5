#pragma once

#include "base/time.h"
#include "daemon/repeat_limit.h"

#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace mfar {

/// Messages for people on standard error. One that nobody takes within half a second is dropped,
/// and the next one says so: no thread hangs for its messages. On a terminal the last line may be a
/// status line, which is redrawn in place; under systemd's journal lines carry a "<priority>"
/// prefix. Thread-safe.
class Log {
public:
    enum class Style { Terminal, Journal, Plain };

    /// Style of standard error as it is now (JOURNAL_STREAM names the journal's socket).
    [[nodiscard]] static Style styleOf(int fd);

    using Clock = std::function<Timestamp()>;
    Log(int fd, Style style, Clock clock = &Timestamp::now)
        : fd_(fd), style_(style), clock_(std::move(clock)) {}

    void error(std::string_view text) { line(3, "error: ", text); }
    /// What may come again and again, as devices do: each event at most once in ten seconds, see
    /// RepeatLimit. Texts of one event that differ, for instance in a number, name it.
    void warning(std::string_view text, std::string_view event = {}) {
        limited(4, "warning: ", text, event);
    }
    /// The same where nothing is wrong.
    void change(std::string_view text, std::string_view event = {}) { limited(5, "", text, event); }
    /// What happens once or on demand: start, reload.
    void notice(std::string_view text) { line(5, "", text); }
    /// Says what was kept back and may be said by now; to be called now and then.
    void sayKept();

    /// Replaces the status line; nothing happens where there is no terminal.
    void status(std::string_view text);
    /// Leaves the status line as it is, says what was kept back and goes on below it.
    void endStatus();

    [[nodiscard]] Style style() const { return style_; }

private:
    void limited(int priority, std::string_view word, std::string_view text,
                 std::string_view event);
    void line(int priority, std::string_view word, std::string_view text);
    void lineLocked(int priority, std::string_view word, std::string_view text);
    void put(std::string_view bytes);
    [[nodiscard]] bool isWritable();

    const int fd_;
    const Style style_;
    const Clock clock_;
    std::mutex mutex_;
    RepeatLimit limit_;
    int dropped_ = 0;     ///< messages since the last one that was written
    std::string status_;  ///< shown now, without line end
};

}  // namespace mfar
