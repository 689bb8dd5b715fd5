#pragma once

#include "base/time.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace mfar {

/// Options of StillMatcher. A window is the largest allowed difference between a still's time and
/// the time that is expected from its pulse.
struct StillMatcherOptions {
    /// First estimate of the delay from a pulse's leading edge to the start of the exposure that
    /// the camera reports. Its error must be less than half the shortest trigger period.
    std::chrono::nanoseconds guess{0};
    /// Largest difference of a still's time from the expected time while the delay is being
    /// learned.
    std::chrono::nanoseconds wideWindow{std::chrono::milliseconds(100)};
    /// The same limit after learning the delay. 1 ms suits timestamps that the sensor takes. If
    /// timestamps are arrival times (USB cameras), more is needed.
    std::chrono::nanoseconds window{std::chrono::milliseconds(1)};
    int learnFrom = 20;  ///< number of matched pulses after which learning ends
    /// If a pulse's still does not arrive within this time after the exposure, the pulse counts as
    /// lost.
    std::chrono::nanoseconds timeout{std::chrono::milliseconds(500)};
    bool repeat = true;  ///< whether a lost pulse is repeated, once
};

struct StillCounters {
    std::uint64_t fired = 0;      ///< number of pulses, with the repeated ones
    std::uint64_t matched = 0;    ///< number of stills that match a pulse, with late ones
    std::uint64_t unmatched = 0;  ///< stills that match no pulse, or one that has a still already
    std::uint64_t lost = 0;      ///< number of pulses whose still did not arrive before the timeout
    std::uint64_t late = 0;      ///< number of lost pulses whose still arrived later
    std::uint64_t repeated = 0;  ///< number of pulses that repeated a lost one
    std::uint64_t relearned = 0;  ///< number of detected steps of the camera's clock
    // TriggeredStillCamera, not StillMatcher, sets `overtaken` and `missedEdges`.
    std::uint64_t overtaken = 0;    ///< matched stills skipped because a later one came first
    std::uint64_t missedEdges = 0;  ///< see Trigger::missedEdges()
};

/// Matches stills to trigger pulses by their times, not by their order, because stills may be late,
/// out of order or missing. Does not use any device. Only one thread at a time may use it.
///
/// A still is expected a constant delay after its pulse. At first, the delay is `guess`; then it is
/// the median over the first `learnFrom` matched pulses. A still matches the nearest pulse if its
/// time is within the window, which is never larger than half the distance to the neighbouring
/// pulses. If five consecutive stills miss the learned window by about the same time, the camera's
/// clock has stepped. Then the median of the five becomes the delay.
class StillMatcher {
public:
    enum class Pulse : std::uint8_t { Asked, Repetition };

    struct Match {
        Timestamp pulse;    ///< time of the leading edge
        Timestamp exposed;  ///< start of the exposure: pulse + constant(), without jitter
        bool late = false;  ///< whether the pulse had been counted as lost
    };

    struct Due {
        int lost = 0;  ///< number of pulses that this call counted as lost
        /// Whether a pulse must be fired now to repeat a lost one. Stays true until pulseFired(..,
        /// Repetition).
        bool repeat = false;
    };

    /// Throws std::invalid_argument if a window, the timeout or learnFrom is not positive, if one
    /// of these times is more than one hour, or if the guess is outside +-1 hour.
    explicit StillMatcher(const StillMatcherOptions& options);

    void pulseFired(Timestamp edge, Pulse kind = Pulse::Asked);
    /// Returns the pulse that a still matches. `exposed`: the start of the exposure that the camera
    /// reports. Returns nothing if no pulse matches; then the still must not be used.
    [[nodiscard]] std::optional<Match> stillArrived(Timestamp exposed);
    /// Counts pulses as lost if their stills are overdue. Requests that each lost pulse is repeated
    /// once. If a repeated pulse is lost, it is not repeated again.
    [[nodiscard]] Due poll(Timestamp now);

    /// Returns the delay from a pulse's leading edge to the start of the exposure: the learned
    /// delay, the median so far while it is being learned, or the guess before the first match.
    [[nodiscard]] std::chrono::nanoseconds constant() const;
    [[nodiscard]] bool learned() const { return learned_.has_value(); }
    [[nodiscard]] const StillCounters& counters() const { return counters_; }

private:
    enum class State : std::uint8_t { Waiting, Matched, Lost };
    struct Fired {
        Timestamp edge;
        Pulse kind = Pulse::Asked;
        State state = State::Waiting;
        bool owed = false;  ///< whether the pulse is lost and has not been repeated
    };
    struct Nearest {
        std::size_t index;
        std::int64_t sinceEdge;  ///< time from the leading edge to the exposure [ns]
    };

    [[nodiscard]] std::optional<Nearest> nearest(Timestamp exposed) const;
    [[nodiscard]] std::int64_t reach(std::size_t index, std::int64_t window) const;
    [[nodiscard]] std::int64_t centre() const;
    void learn(std::int64_t sinceEdge);
    void misfit(const Nearest& still);
    void giveUp(Fired& pulse, int& lost);

    StillMatcherOptions options_;
    std::deque<Fired> pulses_;  ///< the newest pulses, ordered by time
    std::vector<std::int64_t> samples_;
    std::vector<std::int64_t> misfits_;
    std::optional<std::int64_t> learned_;
    StillCounters counters_;
};

}  // namespace mfar
