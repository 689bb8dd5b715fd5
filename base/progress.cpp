#include "base/progress.h"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr std::chrono::milliseconds kRedraw{100};
constexpr std::chrono::seconds kNextLine{10};
constexpr std::string_view kErase = "\r\x1b[K";

std::string clockText(double seconds) {
    const auto whole = static_cast<long>(std::max(seconds, 0.0));
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

std::string frameOf(std::size_t index, std::size_t count) {
    return fmt::format("frame {} of {}", index + 1, count);
}

std::string progressText(double share, std::string_view what, double seconds) {
    if (!std::isfinite(share)) return fmt::format("{}; {}", what, clockText(seconds));
    const double done = std::clamp(share, 0.0, 1.0);
    std::string out = fmt::format("{:3.0f} %  {}; {}", 100 * done, what, clockText(seconds));
    if (done > 0.02 && done < 1 && seconds > 3)
        out += fmt::format(", about {} left", clockText(seconds * (1 - done) / done));
    return out;
}

Progress::Progress(std::FILE* out) : Progress(out, isatty(fileno(out)) == 1) {}

Progress::Progress(std::FILE* out, bool isTerminal) : out_(out), isTerminal_(isTerminal) {}

void Progress::show(double share, std::string_view what, Clock::time_point now) {
    if (now - shown_.value_or(isTerminal_ ? Clock::time_point{} : begin_) <
        (isTerminal_ ? Clock::duration(kRedraw) : Clock::duration(kNextLine)))
        return;
    shown_ = now;
    const std::chrono::duration<double> spent = now - begin_;
    std::string text = progressText(share, what, spent.count());
    // The line is cut to the width of the terminal, because a line that wraps could not be erased.
    winsize size{};
    if (isTerminal_ && ioctl(fileno(out_), TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        text.resize(std::min<std::size_t>(text.size(), size.ws_col - 1U));
    if (isTerminal_)
        fmt::print(out_, "{}{}", kErase, text);
    else
        fmt::print(out_, "{}\n", text);
    isVisible_ = isTerminal_;
    std::fflush(out_);
}

void Progress::clear() {
    if (!isVisible_) return;
    fmt::print(out_, "{}", kErase);
    std::fflush(out_);
    isVisible_ = false;
    shown_.reset();
}

ProgressPart ProgressPart::part(std::size_t index, std::size_t count, std::string_view what) const {
    const double length = 1 / static_cast<double>(std::max<std::size_t>(count, 1));
    const double begin = length * static_cast<double>(index);
    return span(begin, begin + length, what);
}

ProgressPart ProgressPart::span(double begin, double end, std::string_view what) const {
    ProgressPart out = *this;
    out.length_ = length_ * (end - begin);
    out.begin_ = begin_ + length_ * begin;
    if (!what.empty()) out.what_ = what_.empty() ? what : fmt::format("{}, {}", what_, what);
    return out;
}

void ProgressPart::show(std::size_t index, std::size_t count, std::string_view what) const {
    if (all_ == nullptr) return;
    const ProgressPart next = part(index, count, what);
    all_->show(next.begin_, next.what_);
}

}  // namespace mfar
