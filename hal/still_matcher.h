#pragma once

#include "base/time.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace mfar {

/// A window is the largest allowed distance of a still's time from the time that is expected from
/// its pulse.
struct StillMatcherOptions {
    /// First estimate of the time from a pulse's leading edge to the start of exposure that the
    /// camera reports. Its error must be less than half the shortest trigger period.
    std::chrono::nanoseconds guess{0};
    std::chrono::nanoseconds wideWindow{std::chrono::milliseconds(100)};  ///< window while learning
    /// Window after learning. 1 ms suits timestamps from the sensor. Cameras whose timestamps are
    /// arrival times (USB) need more.
    std::chrono::nanoseconds window{std::chrono::milliseconds(1)};
    int learnFrom = 20;  ///< number of matched pulses after which learning ends
    /// A pulse is lost if its still does not arrive within this time after the exposure.
    std::chrono::nanoseconds timeout{std::chrono::milliseconds(500)};
    bool repeat = true;  ///< whether a lost pulse is fired again, once
};

struct StillCounters {
    std::uint64_t fired = 0;      ///< pulses, including repetitions
    std::uint64_t matched = 0;    ///< stills that match a pulse, including late ones
    std::uint64_t unmatched = 0;  ///< stills without a pulse, or whose pulse already has a still
    std::uint64_t lost = 0;       ///< pulses whose still did not arrive before the timeout
    std::uint64_t late = 0;       ///< lost pulses whose still arrived later
    std::uint64_t repeated = 0;   ///< pulses that were fired to repeat a lost one
    std::uint64_t relearned = 0;  ///< detected steps of the camera's clock
    // StillMatcher does not set the following two; TriggeredStillCamera does.
    std::uint64_t overtaken = 0;    ///< matched stills that arrived after a later one: skipped
    std::uint64_t missedEdges = 0;  ///< see Trigger::missedEdges()
};

/// Matches stills to trigger pulses by their times, not by their order, because stills may be late,
/// out of order or missing. Does not use any device. Only one thread at a time may use it.
///
/// A still is expected a constant time after its pulse. This constant is `guess` at first, then the
/// median over the first `learnFrom` matched pulses. A still matches the nearest pulse if its time
/// is within the window, which is never larger than half the distance to the neighbouring pulses.
/// If five stills in a row miss the learned window by about the same time, the camera's clock has
/// stepped. The median of the five then becomes the constant.
class StillMatcher {
public:
    enum class Pulse : std::uint8_t { Asked, Repetition };

    struct Match {
        Timestamp pulse;    ///< leading edge
        Timestamp exposed;  ///< start of exposure: pulse + constant(), so without jitter
        bool late = false;  ///< whether the pulse was counted as lost before
    };

    struct Due {
        int lost = 0;  ///< number of pulses that this call counted as lost
        /// True if a repetition must be fired now. It stays true until pulseFired(.., Repetition).
        bool repeat = false;
    };

    /// Throws std::invalid_argument if a window, the timeout or learnFrom is not positive, if a
    /// time is more than one hour, or if the guess is outside +-1 hour.
    explicit StillMatcher(const StillMatcherOptions& options);

    void pulseFired(Timestamp edge, Pulse kind = Pulse::Asked);
    /// Returns the pulse of a still; `exposed` is the start of exposure that the camera reports.
    /// Returns nothing if no pulse matches; the still must not be used then.
    [[nodiscard]] std::optional<Match> stillArrived(Timestamp exposed);
    /// Counts pulses as lost if their stills are overdue. Requests one repetition for each lost
    /// pulse. A lost repetition is not repeated.
    [[nodiscard]] Due poll(Timestamp now);

    /// Returns the time from a pulse's leading edge to the start of exposure: the learned value.
    /// While it is learned, the median so far; before the first match, the guess.
    [[nodiscard]] std::chrono::nanoseconds constant() const;
    [[nodiscard]] bool learned() const { return learned_.has_value(); }
    [[nodiscard]] const StillCounters& counters() const { return counters_; }

private:
    enum class State : std::uint8_t { Waiting, Matched, Lost };
    struct Fired {
        Timestamp edge;
        Pulse kind = Pulse::Asked;
        State state = State::Waiting;
        bool owed = false;  ///< whether the pulse is lost and not repeated yet
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
