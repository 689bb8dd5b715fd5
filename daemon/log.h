#pragma once

#include <mutex>
#include <string>
#include <string_view>

namespace mfar {

/// Messages for people on standard error. On a terminal the last line may be a status line, which
/// is redrawn in place; under systemd's journal lines carry a "<priority>" prefix. Thread-safe.
class Log {
public:
    enum class Style { Terminal, Journal, Plain };

    /// Style of standard error as it is now (JOURNAL_STREAM names the journal's socket).
    [[nodiscard]] static Style styleOf(int fd);

    Log(int fd, Style style) : fd_(fd), style_(style) {}

    void error(std::string_view text) { line(3, "error: ", text); }
    void warning(std::string_view text) { line(4, "warning: ", text); }
    /// What happens once or on demand: start, reload.
    void notice(std::string_view text) { line(5, "", text); }

    /// Replaces the status line; nothing happens where there is no terminal.
    void status(std::string_view text);
    /// Leaves the status line as it is and goes on below it.
    void endStatus();

    [[nodiscard]] Style style() const { return style_; }

private:
    void line(int priority, std::string_view word, std::string_view text);
    void put(std::string_view bytes) const;

    const int fd_;
    const Style style_;
    std::mutex mutex_;
    std::string status_;  ///< shown now, without line end
};

}  // namespace mfar
