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
/// The expected time of a level is its time in the table, times a factor for this machine and
/// scene: the second largest ratio of measured to table time among the last 20 frames that changed
/// anything. Two late frames within 40 (one more may bring in a still) make the level go down, to
/// the best that is expected to keep the deadline. It goes up when a better level is expected to
/// need at most 85 % of the deadline. A level that missed the deadline is not tried again for a
/// while, which doubles each time.
///
/// Not counted are frames in which nothing changed, frames that bring in a still, and frames
/// without a still at a level that uses one. When the picture comes to rest it is drawn once more
/// at the best level: late, but nothing moves.
class Governor {
public:
    /// At least one level, in rising order of time. `deadlineMs` above zero.
    Governor(std::vector<QualityLevel> levels, double deadlineMs);

    /// The settings for the next frame.
    struct Choice {
        std::size_t level = 0;
        bool redraw = false;  ///< draw the whole picture again

        bool operator==(const Choice&) const = default;
    };
    [[nodiscard]] const Choice& next() const { return next_; }
    [[nodiscard]] const QualityLevel& level() const { return levels_[next_.level]; }

    /// To be called for every frame. Negative or non-finite times are ignored.
    struct Frame {
        double ms = 0;          ///< from the begin of its processing to its picture shown
        bool newStill = false;  ///< a still became the reference just before this frame
        bool usedStill = true;
        double changedBefore = 1;  ///< share of the picture that changed in the previous frame
    };
    void add(const Frame& frame);

    /// False while a still must not be triggered: the level uses none, or a frame that brings in a
    /// still would be late too often.
    [[nodiscard]] bool mayTakeStill() const;

    [[nodiscard]] double deadlineMs() const { return deadline_; }
    /// Number of level changes, without those for frames at rest.
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
    std::size_t level_ = 0;  // for frames that change something
    Choice next_;
    std::optional<Pending> pending_;        // the previous frame, until it is known what changed
    std::array<double, kWindow> ratios_{};  // measured time / table time, ring buffer
    std::size_t ratioCount_ = 0;
    std::uint64_t frame_ = 0;            // number of frames counted
    std::uint64_t changedAt_ = 0;        // value of frame_ at the last change of level
    std::vector<std::uint64_t> lateAt_;  // values of frame_ for late frames since the level changed
    struct Trial {
        std::uint64_t notBefore = 0, wait = 0;  // value of frame_; number of frames
    };
    std::vector<Trial> trials_;
    int restFrames_ = 0;
    bool isPolished_ = false;
    std::uint64_t framesSinceStill_ = 0;
    std::optional<double> stillMs_;
    std::uint64_t changes_ = 0;
};

}  // namespace mfar
