#pragma once

#include "base/time.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace mfar {

/// All windows are half widths: a still belongs to a pulse when it is at most that far from where
/// the pulse's still is expected.
struct StillMatcherOptions {
    /// From a pulse's leading edge to the start of exposure as the camera reports it, until it is
    /// learned. Right to half the shortest trigger period.
    std::chrono::nanoseconds guess{0};
    std::chrono::nanoseconds wideWindow{std::chrono::milliseconds(100)};  ///< while learning
    /// After that. A sensor's clock needs 1 ms; a camera that is timed on arrival (USB) more.
    std::chrono::nanoseconds window{std::chrono::milliseconds(1)};
    int learnFrom = 20;                                                ///< matched pulses
    std::chrono::nanoseconds timeout{std::chrono::milliseconds(500)};  ///< from exposure to arrival
    bool repeat = true;  ///< a pulse without a still is asked for once more
};

struct StillCounters {
    std::uint64_t fired = 0;      ///< pulses, repetitions included
    std::uint64_t matched = 0;    ///< stills that belong to a pulse, late ones included
    std::uint64_t unmatched = 0;  ///< stills that belong to no pulse, or to one that has a still
    std::uint64_t lost = 0;       ///< pulses without a still at their timeout
    std::uint64_t late = 0;       ///< of these, pulses whose still came after all
    std::uint64_t repeated = 0;   ///< pulses fired in place of a lost one
    std::uint64_t relearned = 0;  ///< the camera's clock has stepped
    // Of the camera and its line, not counted here.
    std::uint64_t overtaken = 0;    ///< matched, but after a later one: left out
    std::uint64_t missedEdges = 0;  ///< see Trigger
};

/// Says which still belongs to which pulse, by time and never by order: stills may come late, in
/// another order or not at all. Pure logic; one thread.
///
/// A still is expected a constant after its pulse: the guess at first, later the median of the
/// first `learnFrom` matched pulses. It belongs to the pulse nearest to it when it is within the
/// window, which never reaches further than half way to the neighbouring pulses. When five stills
/// in a row miss the learned window and agree with each other to the window, the camera's clock has
/// stepped, and their median is the constant from then on.
class StillMatcher {
public:
    enum class Pulse : std::uint8_t { Asked, Repetition };

    struct Match {
        Timestamp pulse;    ///< leading edge
        Timestamp exposed;  ///< pulse + constant(): start of exposure, without the still's jitter
        bool late = false;  ///< the pulse had been given up
    };

    struct Due {
        int lost = 0;         ///< pulses given up in this call
        bool repeat = false;  ///< fire one now; stays until pulseFired(.., Repetition)
    };

    /// Throws std::invalid_argument for a window, time or number that is not positive, a time
    /// above an hour, and a guess beyond one hour either way.
    explicit StillMatcher(const StillMatcherOptions& options);

    void pulseFired(Timestamp edge, Pulse kind = Pulse::Asked);
    /// `exposed` is the start of exposure as the camera reports it. Nothing: not to be used.
    [[nodiscard]] std::optional<Match> stillArrived(Timestamp exposed);
    /// Gives up pulses whose still has not come. Each lost pulse is asked for once more, but a
    /// repetition never.
    [[nodiscard]] Due poll(Timestamp now);

    /// From edge to exposure: learned, or the median so far, or the guess.
    [[nodiscard]] std::chrono::nanoseconds constant() const;
    [[nodiscard]] bool learned() const { return learned_.has_value(); }
    [[nodiscard]] const StillCounters& counters() const { return counters_; }

private:
    enum class State : std::uint8_t { Waiting, Matched, Lost };
    struct Fired {
        Timestamp edge;
        Pulse kind = Pulse::Asked;
        State state = State::Waiting;
        bool owed = false;  ///< lost, and not repeated yet
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
    std::deque<Fired> pulses_;  ///< by time; the newest few dozen
    std::vector<std::int64_t> samples_;
    std::vector<std::int64_t> misfits_;
    std::optional<std::int64_t> learned_;
    StillCounters counters_;
};

}  // namespace mfar
