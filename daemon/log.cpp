#include "daemon/log.h"

#include <fmt/format.h>

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cstdlib>

namespace mfar {
namespace {

constexpr int kPatienceMs = 500;

int columns(int fd) {
    winsize size{};
    return ioctl(fd, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
}

}  // namespace

Log::Style Log::styleOf(int fd) {
    if (isatty(fd) == 1) return Style::Terminal;
    const char* journal = std::getenv("JOURNAL_STREAM");
    struct stat file{};
    if (journal != nullptr && fstat(fd, &file) == 0 &&
        fmt::format("{}:{}", file.st_dev, file.st_ino) == journal)
        return Style::Journal;
    return Style::Plain;
}

void Log::status(std::string_view text) {
    if (style_ != Style::Terminal) return;
    const std::lock_guard lock(mutex_);
    // A line longer than the terminal would wrap and could not be redrawn in place.
    status_ = text.substr(0, static_cast<std::size_t>(columns(fd_) - 1));
    put("\r\x1b[K" + status_);
}

void Log::endStatus() {
    const std::lock_guard lock(mutex_);
    for (const RepeatLimit::Message& kept : limit_.rest(clock_()))
        lineLocked(kept.priority, "", kept.text);
    if (status_.empty()) return;
    status_.clear();
    put("\n");
}

void Log::sayKept() {
    const std::lock_guard lock(mutex_);
    for (const RepeatLimit::Message& kept : limit_.due(clock_()))
        lineLocked(kept.priority, "", kept.text);
}

void Log::limited(int priority, std::string_view word, std::string_view text,
                  std::string_view event) {
    const std::lock_guard lock(mutex_);
    const RepeatLimit::Message message{priority, std::string(word) + std::string(text)};
    if (limit_.mayPass(event.empty() ? text : event, message, clock_()))
        lineLocked(priority, word, text);
}

void Log::line(int priority, std::string_view word, std::string_view text) {
    const std::lock_guard lock(mutex_);
    lineLocked(priority, word, text);
}

void Log::lineLocked(int priority, std::string_view word, std::string_view text) {
    std::string out = status_.empty() ? "" : "\r\x1b[K";
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        if (style_ == Style::Journal) out += fmt::format("<{}>", priority);
        out += fmt::format("mfard: {}{}\n", word, text.substr(0, end));
        text = end == text.npos ? "" : text.substr(end + 1);
    }
    put(out + status_);
}

// The first message that is not taken is waited for, those after it are not.
bool Log::isWritable() {
    pollfd out{fd_, POLLOUT, 0};
    const int patience = dropped_ == 0 ? kPatienceMs : 0;
    return poll(&out, 1, patience) != 0;
}

void Log::put(std::string_view bytes) {
    // Where standard error cannot be written there is nobody left to tell.
    std::string all;
    if (dropped_ > 0) all = fmt::format("mfard: {} messages were not taken\n", dropped_);
    all += bytes;
    std::string_view left = all;
    while (!left.empty()) {
        if (!isWritable()) {
            ++dropped_;
            return;
        }
        // A pipe that polls as writable takes this much without blocking.
        const ssize_t n = write(fd_, left.data(), std::min<std::size_t>(left.size(), PIPE_BUF));
        if (n <= 0) return;
        left.remove_prefix(static_cast<std::size_t>(n));
    }
    dropped_ = 0;
}

}  // namespace mfar
