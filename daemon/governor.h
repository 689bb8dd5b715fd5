#pragma once

#include "daemon/quality_table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Picks the most accurate level of a quality table whose frames keep a deadline, frame by frame.
/// Pure logic on the frames' times; used by one thread.
///
/// What a level takes here is told by the table's times, scaled by what the frames before took in
/// comparison: the second longest of the last 20 that changed anything. Two late ones within 40,
/// where one more may bring in a still: the level goes down, as far as that says. It goes up when a
/// better one is expected to need 85 % of the deadline at most; one that did not keep it is
/// not tried again for a while, each time for twice as long.
///
/// Frames in which nothing changed, those that bring in a still, and those that have none though
/// the level would use one, say nothing about a level.
/// When the picture comes to rest it is drawn once more at the best level: late, but nothing moves.
class Governor {
public:
    /// At least one level, in rising order of time. `deadlineMs` above zero.
    Governor(std::vector<QualityLevel> levels, double deadlineMs);

    /// What the next frame is to be computed with.
    struct Choice {
        std::size_t level = 0;
        bool redraw = false;  ///< all of it anew

        bool operator==(const Choice&) const = default;
    };
    [[nodiscard]] const Choice& next() const { return next_; }
    [[nodiscard]] const QualityLevel& level() const { return levels_[next_.level]; }

    /// Told of every frame. Not finite or negative times are ignored.
    struct Frame {
        double ms = 0;          ///< from its begin to its picture shown
        bool newStill = false;  ///< a still became the reference before it
        bool usedStill = true;
        double changedBefore = 1;  ///< share of the picture that changed in the frame before this
    };
    void add(const Frame& frame);

    /// A still may be asked for: frames that bring one in and are late for it are rare enough, and
    /// the level makes use of it.
    [[nodiscard]] bool mayTakeStill() const;

    [[nodiscard]] double deadlineMs() const { return deadline_; }
    /// Times that the level changed, but for frames at rest.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }

private:
    static constexpr std::size_t kWindow = 20;  // frames

    struct Pending {
        double ms;
        bool counts, redrawn;
    };
    void count(double ms);
    void rest();
    void goTo(std::size_t level);
    void goDown();
    void goUp();
    [[nodiscard]] std::size_t bestWithin(double ms) const;
    [[nodiscard]] double ratio() const;
    [[nodiscard]] double expected(std::size_t level) const;

    std::vector<QualityLevel> levels_;
    double deadline_;
    std::size_t level_ = 0;  // of frames that change something
    Choice next_;
    std::optional<Pending> pending_;        // the frame before, until it is known what changed
    std::array<double, kWindow> ratios_{};  // of times to the table's, the newest of a ring
    std::size_t ratioCount_ = 0;
    std::uint64_t frame_ = 0;            // of those that count
    std::uint64_t changedAt_ = 0;        // frame_
    std::vector<std::uint64_t> lateAt_;  // frame_ of late ones since the level changed
    struct Trial {
        std::uint64_t notBefore = 0, wait = 0;  // frame_; frames
    };
    std::vector<Trial> trials_;
    int restFrames_ = 0;
    bool isPolished_ = false;
    std::uint64_t framesSinceStill_ = 0;
    std::optional<double> stillMs_;
    std::uint64_t changes_ = 0;
};

}  // namespace mfar
