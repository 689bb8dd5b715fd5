#pragma once

#include "base/time.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace mfar {

/// Options of StillMatcher. A window is the largest accepted difference between a still's reported
/// time and the time expected from its pulse. A still with a larger difference does not match.
struct StillMatcherOptions {
    /// First estimate of the delay from a pulse's leading edge to the exposure's start as the
    /// camera reports it. Its error must be less than half the shortest trigger period. If it
    /// is more than `wideWindow`, the first five stills are lost.
    std::chrono::nanoseconds guess{0};
    /// Window while the delay is being learned.
    std::chrono::nanoseconds wideWindow{std::chrono::milliseconds(100)};
    /// Window once the delay is learned, see above. 1 ms suits cameras whose times come from the
    /// sensor. USB cameras report arrival times, which need a larger window.
    std::chrono::nanoseconds window{std::chrono::milliseconds(1)};
    int learnFrom = 20;
    /// If a still does not arrive within this time after the expected start of its exposure, its
    /// pulse counts as lost.
    std::chrono::nanoseconds timeout{std::chrono::milliseconds(500)};
    bool repeat = true;
};

struct StillCounters {
    std::uint64_t fired = 0;    ///< pulses, including the repeated ones
    std::uint64_t matched = 0;  ///< stills that match a pulse, including late ones
    /// Stills that match no pulse, or a pulse that already has a still.
    std::uint64_t unmatched = 0;
    std::uint64_t lost = 0;  ///< pulses whose still did not arrive before the timeout
    std::uint64_t late = 0;  ///< matched stills whose pulse was already counted as lost
    std::uint64_t repeated = 0;
    std::uint64_t relearned = 0;
    /// Matched stills that were skipped because a newer still came first.
    std::uint64_t overtaken = 0;
    std::uint64_t missedEdges = 0;
};

/// Matches stills to trigger pulses by their times, because stills may be late, out of order or
/// missing. Only one thread at a time may use it.
///
/// The expected time of a pulse's still is the pulse's time plus a delay. The delay is `guess` at
/// first, later the median of the delays of the first `learnFrom` matched stills. A still matches
/// the pulse whose expected time is nearest to the still's time, if the difference is at most the
/// window. The window is never larger than half the time between two pulses. If five consecutive
/// stills miss the window by about the same time, the camera's clock or its automatic exposure has
/// stepped, or `guess` was wrong. Then the median of their delays becomes the delay.
class StillMatcher {
public:
    enum class Pulse : std::uint8_t { Asked, Repetition };

    struct Match {
        Timestamp pulse;
        Timestamp exposed;  ///< start of the exposure: pulse + constant(), without jitter
        bool late = false;
    };

    struct Due {
        int lost = 0;  ///< number of pulses that this call of poll() counted as lost
        /// True if a pulse must be fired now to repeat a lost one. Stays true until pulseFired(...,
        /// Repetition), or until the still of the lost pulse arrives.
        bool repeat = false;
    };

    /// Throws std::invalid_argument if an option is outside its range: windows and timeout (0, 1
    /// h], guess [-1 h, 1 h], learnFrom at least 1.
    explicit StillMatcher(const StillMatcherOptions& options);

    void pulseFired(Timestamp edge, Pulse kind = Pulse::Asked);
    /// Returns the pulse that a still matches. `exposed` is the start of the exposure as the camera
    /// reports it. If no pulse matches, or the pulse already has a still, returns nothing, and the
    /// still must not be used.
    [[nodiscard]] std::optional<Match> stillArrived(Timestamp exposed);
    /// Counts pulses as lost if their stills are overdue. A pulse is repeated at most once.
    [[nodiscard]] Due poll(Timestamp now);

    /// Returns the delay from a pulse's leading edge to the start of the exposure. It is `guess`
    /// before the first match, and the median of the matches so far while it is being learned.
    [[nodiscard]] std::chrono::nanoseconds constant() const;
    [[nodiscard]] bool learned() const { return learned_.has_value(); }
    [[nodiscard]] const StillCounters& counters() const { return counters_; }

private:
    enum class State : std::uint8_t { Waiting, Matched, Lost };
    struct Fired {
        Timestamp edge;
        Pulse kind = Pulse::Asked;
        State state = State::Waiting;
        bool owed = false;
    };
    struct Nearest {
        std::size_t index;
        std::int64_t sinceEdge;
    };

    [[nodiscard]] std::optional<Nearest> nearest(Timestamp exposed) const;
    [[nodiscard]] std::int64_t reach(std::size_t index, std::int64_t window) const;
    [[nodiscard]] std::int64_t centre() const;
    void learn(std::int64_t sinceEdge);
    void misfit(const Nearest& still);
    void giveUp(Fired& pulse, int& lost);

    StillMatcherOptions options_;
    std::deque<Fired> pulses_;
    std::vector<std::int64_t> samples_;
    std::vector<std::int64_t> misfits_;
    std::optional<std::int64_t> learned_;
    StillCounters counters_;
};

}  // namespace mfar
