#include "daemon/log.h"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

namespace mfar {
namespace {

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
    if (status_.empty()) return;
    status_.clear();
    put("\n");
}

void Log::line(int priority, std::string_view word, std::string_view text) {
    const std::lock_guard lock(mutex_);
    std::string out = status_.empty() ? "" : "\r\x1b[K";
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        if (style_ == Style::Journal) out += fmt::format("<{}>", priority);
        out += fmt::format("mfard: {}{}\n", word, text.substr(0, end));
        text = end == text.npos ? "" : text.substr(end + 1);
    }
    put(out + status_);
}

void Log::put(std::string_view bytes) const {
    // Where standard error cannot be written there is nobody left to tell.
    while (!bytes.empty()) {
        const ssize_t n = write(fd_, bytes.data(), bytes.size());
        if (n <= 0) return;
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
}

}  // namespace mfar
