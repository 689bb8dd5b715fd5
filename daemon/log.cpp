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

std::vector<std::string> fieldsOf(const RepeatLimit::Message& message) {
    std::vector<std::string> out = {fmt::format("MESSAGE={}{}", message.word, message.text),
                                    fmt::format("PRIORITY={}", message.priority),
                                    "SYSLOG_IDENTIFIER=mfard",
                                    fmt::format("MFAR_COUNT={}", message.count)};
    const auto add = [&](const char* name, std::string_view value) {
        if (!value.empty()) out.push_back(fmt::format("{}={}", name, value));
    };
    add("MESSAGE_ID", message.subject.id);
    add("MFAR_CAMERA", message.subject.camera);
    add("MFAR_THREAD", message.subject.thread);
    return out;
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
    // The line is cut to the terminal's width, because a line that wraps cannot be redrawn in
    // place.
    status_ = text.substr(0, static_cast<std::size_t>(columns(fd_) - 1));
    std::ranges::replace(status_, '\n', ' ');
    put("\r\x1b[K" + status_);
}

void Log::endStatus() {
    const std::lock_guard lock(mutex_);
    for (const RepeatLimit::Message& kept : limit_.rest(clock_()))
        say(kept);
    if (status_.empty()) return;
    status_.clear();
    put("\n");
}

void Log::sayKept() {
    const std::lock_guard lock(mutex_);
    for (const RepeatLimit::Message& kept : limit_.due(clock_()))
        say(kept);
}

void Log::limited(int priority, std::string_view word, std::string_view text,
                  std::string_view event, const Subject& subject) {
    const std::lock_guard lock(mutex_);
    const RepeatLimit::Message message{priority, std::string(text), word, subject};
    if (limit_.mayPass(event.empty() ? text : event, message, clock_())) say(message);
}

void Log::line(int priority, std::string_view word, std::string_view text, const Subject& subject) {
    const std::lock_guard lock(mutex_);
    say({priority, std::string(text), word, subject});
}

/// The caller must have locked mutex_.
void Log::say(const RepeatLimit::Message& message) {
    if (style_ == Style::Journal && send_ && send_(fieldsOf(message))) return;
    std::string out = status_.empty() ? "" : "\r\x1b[K";
    for (std::string_view text = message.text; !text.empty();) {
        const std::size_t end = text.find('\n');
        if (style_ == Style::Journal) out += fmt::format("<{}>", message.priority);
        out += fmt::format("mfard: {}{}\n", message.word, text.substr(0, end));
        text = end == text.npos ? "" : text.substr(end + 1);
    }
    put(out + status_);
}

// Waits at most kPatienceMs until the output accepts bytes. Returns false if it does not. After a
// message was dropped, does not wait, so that many messages in a row cause only one wait.
bool Log::isWritable() {
    pollfd out{fd_, POLLOUT, 0};
    const int patience = dropped_ == 0 ? kPatienceMs : 0;
    return poll(&out, 1, patience) != 0;
}

void Log::put(std::string_view bytes) {
    // Errors of writing are ignored, because they cannot be reported anywhere.
    std::string all;
    if (dropped_ > 0)
        all = fmt::format("mfard: {} messages were dropped, because standard error was full\n",
                          dropped_);
    all += bytes;
    std::string_view left = all;
    while (!left.empty()) {
        if (!isWritable()) {
            ++dropped_;
            return;
        }
        // poll() reports a pipe as writable if PIPE_BUF bytes can be written without blocking.
        const ssize_t n = write(fd_, left.data(), std::min<std::size_t>(left.size(), PIPE_BUF));
        if (n <= 0) return;
        left.remove_prefix(static_cast<std::size_t>(n));
    }
    dropped_ = 0;
}

}  // namespace mfar
