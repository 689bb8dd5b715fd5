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
    double explainedBelow = 0.6;  ///< mode demand: threshold, share of the picture, [0, 1]
    double maxAgeS = 10;          ///< mode demand: an older still is replaced while the scene moves
    double minIntervalS = 0.3;    ///< mode demand: lower limit of the time between triggers
    double timeoutS = 3;          ///< a still that has not come after this time is lost

    bool operator==(const TriggerConfig&) const = default;
};

/// Decides when the still sensor fires. Pure logic on the time of the video frames; called once per
/// frame, by one thread.
///
/// A lost still is counted and requested again at once. When that one is lost too, the policy waits
/// for maxAgeS (mode demand), the next period (mode rate), or ask() (mode off).
class StillPolicy {
public:
    explicit StillPolicy(const TriggerConfig& config) : config_(config) {}

    /// Takes effect with the next decision. A pending still stays pending unless the mode changes
    /// to Off.
    void configure(const TriggerConfig& config);

    /// True: the caller must fire now (the policy relies on it). `now` is the time of the newest
    /// frame, `stats` are those of the frame of time `statsOf`, which may be older.
    [[nodiscard]] bool decide(Timestamp now, Timestamp statsOf, const FrameStats& stats);

    /// Requests one still in any mode: the next decision without a pending still fires.
    void ask() { asked_ = true; }

    /// The trigger could not fire because its last pulse was still on: the next decision fires
    /// again.
    void busy();

    /// A still has become the reference of the next decided frame and those after it. A still that
    /// was exposed before the last trigger is a late answer to an earlier trigger.
    void stillArrived(Timestamp exposed);

    [[nodiscard]] bool pending() const { return firedAt_ && !arrived_; }
    [[nodiscard]] int fired() const { return fired_; }
    [[nodiscard]] int lost() const { return lost_; }
    /// Number of triggers that repeated a lost still, included in fired().
    [[nodiscard]] int repetitions() const { return repetitions_; }

private:
    [[nodiscard]] bool wanted(Timestamp now, Timestamp statsOf, const FrameStats& stats) const;
    [[nodiscard]] bool timedOut(Timestamp now);
    void fire(Timestamp now);

    TriggerConfig config_;
    std::optional<Timestamp> still_;      ///< exposure of the current reference
    std::optional<Timestamp> usedSince_;  ///< first frame drawn with that reference and mode
    std::optional<Timestamp> firedAt_;    ///< the last trigger
    bool arrived_ = true;                 ///< the last trigger's still has come or is given up
    bool repeated_ = false;               ///< the last trigger was the repetition of a lost one
    bool movedSinceTrigger_ = false;
    bool movedInUse_ = false;  ///< the scene moved since the reference was first used
    bool asked_ = false;
    std::optional<Timestamp> due_;        ///< mode rate: the next trigger
    std::optional<Timestamp> notBefore_;  ///< after two lost stills
    int fired_ = 0;
    int lost_ = 0;
    int repetitions_ = 0;
};

}  // namespace mfar
