#pragma once

#include "daemon/quality_table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Chooses a level of a quality table for each frame: the most accurate level that keeps a
/// deadline. It uses the measured times of frames, see Frame. Only one thread may use it.
///
/// The expected time of a level is its time in the table, multiplied by a factor for this machine
/// and scene. The factor comes from the ratios of measured time to table time of the last 20
/// counted frames. It is the second largest of these ratios, or the largest if there are fewer than
/// ten.
///
/// If two of 40 counted frames are late, the governor changes to the best faster level that is
/// expected to need at most 95 % of the deadline, or to the fastest level. If better levels are
/// expected to need at most 85 % of the deadline, it changes to the best of them. After a level
/// missed the deadline, the governor does not change to it from a faster level for some counted
/// frames. Their number doubles each time.
///
/// If a part of the time is the same at all levels, the factor overestimates the time of a better
/// level. So after 100 counted frames at a level, of which none of the last 40 was late, another
/// estimate of the next better level's time is used: the expected time of the current level, plus
/// the difference between both levels' times in the table. If this is at most 85 % of the deadline,
/// the governor tries the better level.
///
/// Some frames are not counted:
///   - frames in which nothing was drawn;
///   - frames with a new still, unless the frame before also had a new still;
///   - frames without a still, if the level uses stills;
///   - the frame that is drawn once more at the best level when the picture comes to rest. It may
///     be late, because nothing moves in it.
class Governor {
public:
    /// `levels` must not be empty and must be sorted by time, the fastest first. `deadlineMs` must
    /// be greater than zero.
    Governor(std::vector<QualityLevel> levels, double deadlineMs);

    struct Choice {
        std::size_t level = 0;
        bool redraw = false;

        bool operator==(const Choice&) const = default;
    };
    [[nodiscard]] const Choice& next() const { return next_; }
    [[nodiscard]] const QualityLevel& level() const { return levels_[next_.level]; }

    struct Frame {
        double ms = 0;          ///< time from the start of processing to the shown picture
        bool newStill = false;  ///< a still became the reference just before this frame
        bool usedStill = true;
        double redrawn = 1;  ///< FrameStats::redrawn
    };
    /// Must be called for every frame. Frames whose time is negative or not finite are ignored.
    void add(const Frame& frame);

    /// Returns true if the next frame may get a new still. Returns false if the level uses no
    /// still. If the last frame with a new still was late, returns false for the next 40 frames, so
    /// that not too many frames are late.
    [[nodiscard]] bool mayTakeStill() const;

    [[nodiscard]] double deadlineMs() const { return deadline_; }
    /// Returns the number of level changes. The change to the best level for a picture at rest does
    /// not count.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }

private:
    static constexpr std::size_t kWindow = 20;

    void count(double ms);
    void rest();
    void goTo(std::size_t level);
    void goDown();
    void goUp();
    [[nodiscard]] bool mayTry(std::size_t level) const;
    [[nodiscard]] std::size_t bestWithin(double ms) const;
    [[nodiscard]] double ratio() const;
    [[nodiscard]] double expected(std::size_t level) const;

    std::vector<QualityLevel> levels_;
    double deadline_;
    std::size_t level_ = 0;
    Choice next_;
    std::array<double, kWindow> ratios_{};  // measured time / table time, ring buffer
    std::size_t ratioCount_ = 0;
    std::uint64_t frame_ = 0;      // number of counted frames
    std::uint64_t changedAt_ = 0;  // value of frame_ at the last change of level
    // Values of frame_ at the late frames since changedAt_, of the last 40 counted frames at most.
    std::vector<std::uint64_t> lateAt_;
    struct Trial {
        // The governor does not change from a faster level to this level until frame_ reaches
        // `notBefore`. It may change to it from a slower level, and use it for the redraw at rest.
        // `wait` is the length of the level's last waiting time [counted frames].
        std::uint64_t notBefore = 0, wait = 0;
    };
    std::vector<Trial> trials_;
    int restFrames_ = 0;
    bool isPolished_ = false;
    std::uint64_t framesSinceStill_ = 0;
    std::optional<double> stillMs_;
    std::uint64_t changes_ = 0;
};

}  // namespace mfar
