#pragma once

#include "base/time.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace mfar {

/// All windows are half widths: a still matches a pulse when its time is at most that far from the
/// expected time.
struct StillMatcherOptions {
    /// Assumed time from a pulse's leading edge to the start of exposure as the camera reports it,
    /// until it is learned. Must be correct to half the shortest trigger period.
    std::chrono::nanoseconds guess{0};
    std::chrono::nanoseconds wideWindow{std::chrono::milliseconds(100)};  ///< window while learning
    /// Window after learning. 1 ms for a sensor's clock; more for a camera timed on arrival (USB).
    std::chrono::nanoseconds window{std::chrono::milliseconds(1)};
    int learnFrom = 20;                                                ///< number of matched pulses
    std::chrono::nanoseconds timeout{std::chrono::milliseconds(500)};  ///< from exposure to arrival
    bool repeat = true;  ///< fire again once for a pulse without a still
};

struct StillCounters {
    std::uint64_t fired = 0;      ///< pulses, repetitions included
    std::uint64_t matched = 0;    ///< stills that belong to a pulse, late ones included
    std::uint64_t unmatched = 0;  ///< stills without a pulse, or whose pulse already has a still
    std::uint64_t lost = 0;       ///< pulses without a still at the timeout
    std::uint64_t late = 0;       ///< lost pulses whose still arrived later
    std::uint64_t repeated = 0;   ///< pulses fired to replace a lost one
    std::uint64_t relearned = 0;  ///< steps of the camera's clock
    // Counted by the camera and the line, not here.
    std::uint64_t overtaken = 0;    ///< matched, but arrived after a later still: skipped
    std::uint64_t missedEdges = 0;  ///< see Trigger
};

/// Matches stills to pulses by time and never by order: stills may be late, out of order or
/// missing. Pure logic; one thread.
///
/// A still is expected a constant time after its pulse: `guess` at first, later the median of the
/// first `learnFrom` matched pulses. It matches the nearest pulse if it is within the window, which
/// never extends beyond half the distance to the neighbouring pulses. When five stills in a row
/// miss the learned window but agree with each other to the window, the camera's clock has stepped,
/// and their median becomes the constant.
class StillMatcher {
public:
    enum class Pulse : std::uint8_t { Asked, Repetition };

    struct Match {
        Timestamp pulse;    ///< leading edge
        Timestamp exposed;  ///< pulse + constant(): start of exposure, without the still's jitter
        bool late = false;  ///< the pulse had been counted as lost
    };

    struct Due {
        int lost = 0;  ///< pulses counted as lost in this call
        /// Fire a repetition now; stays true until pulseFired(.., Repetition).
        bool repeat = false;
    };

    /// Throws std::invalid_argument for a window, time or number that is not positive, a time above
    /// one hour, or a guess beyond +-1 hour.
    explicit StillMatcher(const StillMatcherOptions& options);

    void pulseFired(Timestamp edge, Pulse kind = Pulse::Asked);
    /// `exposed` is the start of exposure as the camera reports it. Empty: the still must not be
    /// used.
    [[nodiscard]] std::optional<Match> stillArrived(Timestamp exposed);
    /// Counts pulses as lost whose still is overdue. Requests one repetition for each lost pulse,
    /// but none for a repetition.
    [[nodiscard]] Due poll(Timestamp now);

    /// Time from edge to exposure: learned, else the median so far, else the guess.
    [[nodiscard]] std::chrono::nanoseconds constant() const;
    [[nodiscard]] bool learned() const { return learned_.has_value(); }
    [[nodiscard]] const StillCounters& counters() const { return counters_; }

private:
    enum class State : std::uint8_t { Waiting, Matched, Lost };
    struct Fired {
        Timestamp edge;
        Pulse kind = Pulse::Asked;
        State state = State::Waiting;
        bool owed = false;  ///< lost and not repeated yet
    };
    struct Nearest {
        std::size_t index;
        std::int64_t sinceEdge;  ///< [ns]
    };

    [[nodiscard]] std::optional<Nearest> nearest(Timestamp exposed) const;
    [[nodiscard]] std::int64_t reach(std::size_t index, std::int64_t window) const;
    [[nodiscard]] std::int64_t centre() const;
    void learn(std::int64_t sinceEdge);
    void misfit(const Nearest& still);
    void giveUp(Fired& pulse, int& lost);

    StillMatcherOptions options_;
    std::deque<Fired> pulses_;  ///< ordered by time; the newest few dozen
    std::vector<std::int64_t> samples_;
    std::vector<std::int64_t> misfits_;
    std::optional<std::int64_t> learned_;
    StillCounters counters_;
};

}  // namespace mfar
