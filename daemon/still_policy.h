#pragma once

#include "base/time.h"
#include "pipeline/results.h"

#include <chrono>
#include <optional>

namespace mfar {

enum class TriggerMode {
    Demand,  ///< when the current still no longer explains the picture
    Rate,    ///< at a fixed rate
    Off,     ///< never
};

struct TriggerConfig {
    TriggerMode mode = TriggerMode::Demand;
    double rateHz = 2;            ///< mode rate: stills per second
    double explainedBelow = 0.6;  ///< mode demand: share of the picture, [0, 1]
    double maxAgeS = 10;          ///< mode demand: a still older than this is renewed in motion
    double minIntervalS = 0.3;    ///< mode demand: never faster than this
    double timeoutS = 3;          ///< a still that has not come by then is lost

    bool operator==(const TriggerConfig&) const = default;
};

/// Decides when the still sensor fires. Pure logic on the time of the video frames; asked once per
/// frame, by one thread.
///
/// A lost still is counted and asked for once more at once. When that one is lost too, the policy
/// waits for maxAgeS (mode demand), the next period (mode rate), or somebody to ask (mode off).
class StillPolicy {
public:
    explicit StillPolicy(const TriggerConfig& config) : config_(config) {}

    /// Takes effect with the next decision; a pending still stays pending unless the mode turns
    /// off.
    void configure(const TriggerConfig& config);

    /// True: fire now (and the policy counts on that). `now` is the time of the newest frame,
    /// `stats` may be those of an earlier one, of time `statsOf`.
    [[nodiscard]] bool decide(Timestamp now, Timestamp statsOf, const FrameStats& stats);

    /// Somebody wants a still: the next decision that does not wait for one is to fire, in any
    /// mode.
    void ask() { asked_ = true; }

    /// The trigger could not fire as its last pulse was still on: the next decision is to.
    void busy();

    /// A still has become the reference of the frame that is decided on next, and of those after
    /// it. One that was exposed before the last trigger is a late answer to the trigger before it.
    void stillArrived(Timestamp exposed);

    [[nodiscard]] bool pending() const { return firedAt_ && !arrived_; }
    [[nodiscard]] int fired() const { return fired_; }
    [[nodiscard]] int lost() const { return lost_; }
    /// Of fired(), those in place of a lost one.
    [[nodiscard]] int repetitions() const { return repetitions_; }

private:
    [[nodiscard]] bool wanted(Timestamp now, Timestamp statsOf, const FrameStats& stats) const;
    [[nodiscard]] bool timedOut(Timestamp now);
    void fire(Timestamp now);

    TriggerConfig config_;
    std::optional<Timestamp> still_;      ///< exposure of the current reference
    std::optional<Timestamp> usedSince_;  ///< first frame drawn with that reference and mode
    std::optional<Timestamp> firedAt_;    ///< the last trigger
    bool arrived_ = true;                 ///< the answer to the last trigger is settled
    bool repeated_ = false;  ///< the last trigger was itself the repetition of a lost one
    bool movedSinceTrigger_ = false;
    bool movedInUse_ = false;  ///< since the reference was first used
    bool asked_ = false;
    std::optional<Timestamp> due_;        ///< mode rate: the next trigger
    std::optional<Timestamp> notBefore_;  ///< after two lost stills
    int fired_ = 0;
    int lost_ = 0;
    int repetitions_ = 0;
};

}  // namespace mfar
