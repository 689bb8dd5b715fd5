#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Shows on `out` what a long command does and how far it is. On a terminal, it rewrites one line,
/// at most ten times a second; otherwise it prints lines, at most one in ten seconds. Not
/// thread-safe.
class Progress {
public:
    using Clock = std::chrono::steady_clock;

    explicit Progress(std::FILE* out = stderr);
    Progress(std::FILE* out, bool isTerminal);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { clear(); }

    /// Shows the finished share of the whole work (0 to 1) and the next step, `what`. If the
    /// share is NaN, it is unknown and not shown.
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

/// The progress of a part of the work. A part can have parts itself. A default-constructed
/// ProgressPart shows nothing, so that functions can be called without a Progress.
class ProgressPart {
public:
    ProgressPart() = default;
    explicit ProgressPart(Progress& all) : all_(&all) {}

    /// Returns part number `index` of `count` equal parts. The text of the new part is the text of
    /// this part, followed by `what`.
    [[nodiscard]] ProgressPart part(std::size_t index, std::size_t count,
                                    std::string_view what) const;
    /// Returns the part from `begin` to `end`, which are shares of this part. Its text is like that
    /// of part().
    [[nodiscard]] ProgressPart span(double begin, double end, std::string_view what) const;
    void show(std::size_t index, std::size_t count, std::string_view what) const;

private:
    Progress* all_ = nullptr;
    double begin_ = 0, length_ = 1;  ///< begin and length of this part, as shares of the whole work
    std::string what_{};
};

[[nodiscard]] std::string frameOf(std::size_t index, std::size_t count);

[[nodiscard]] std::string progressText(double share, std::string_view what, double seconds);

}  // namespace mfar
