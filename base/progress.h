#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Shows on standard error what a long command does and how far it is: on a terminal a line that is
/// rewritten at most ten times a second, elsewhere a line every ten seconds. One thread.
class Progress {
public:
    using Clock = std::chrono::steady_clock;

    explicit Progress(std::FILE* out = stderr);
    /// As on a terminal or not, for tests.
    Progress(std::FILE* out, bool isTerminal);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    /// Erases the line.
    ~Progress() { clear(); }

    /// `share` of the whole work is done, [0, 1], and `what` is next. NaN: the share is unknown.
    void show(double share, std::string_view what, Clock::time_point now = Clock::now());
    /// Erases the line, so that other output can follow. The next show() draws it again.
    void clear();

private:
    std::FILE* out_;
    bool isTerminal_;
    bool isVisible_ = false;
    Clock::time_point begin_ = Clock::now();
    std::optional<Clock::time_point> shown_;
};

/// The progress of a part of the work, which has parts itself. Copyable; parts of nothing show
/// nothing, so that a function can be called without a Progress.
class ProgressPart {
public:
    ProgressPart() = default;
    explicit ProgressPart(Progress& all) : all_(&all) {}

    /// Part number `index` of `count` equal ones; its `what` is appended.
    [[nodiscard]] ProgressPart part(std::size_t index, std::size_t count,
                                    std::string_view what) const;
    /// Shows the begin of part number `index` of `count`.
    void show(std::size_t index, std::size_t count, std::string_view what) const;

private:
    Progress* all_ = nullptr;
    double begin_ = 0, length_ = 1;  ///< of the whole
    std::string what_{};
};

/// "frame 3 of 29" of index 2.
[[nodiscard]] std::string frameOf(std::size_t index, std::size_t count);

/// "34 %  superres office, frame 3 of 29; 0:12, about 0:25 left".
[[nodiscard]] std::string progressText(double share, std::string_view what, double seconds);

}  // namespace mfar
