#pragma once

#include "base/time.h"
#include "pipeline/results.h"

#include <chrono>
#include <optional>

namespace mfar {

enum class TriggerMode {
    Demand,  ///< trigger if the current still explains too little of the picture
    Rate,
    Off,
};

struct TriggerConfig {
    TriggerMode mode = TriggerMode::Demand;
    double rateHz = 2;
    /// mode demand: trigger if FrameStats::explained is less than this
    double explainedBelow = 0.6;
    double maxAgeS = 10;        ///< mode demand: an older still is replaced if the scene has moved
    double minIntervalS = 0.3;  ///< mode demand: shortest time between two triggers
    /// A still that arrives more than this time after its trigger counts as lost.
    double timeoutS = 3;

    bool operator==(const TriggerConfig&) const = default;
};

/// Decides when the still sensor is triggered. It uses only the times and statistics of video
/// frames. Only one thread may use it.
///
/// If a still is lost, it is counted, and another still is requested at once. If that one is lost,
/// too, the policy waits: for maxAgeS, at most 10 s (mode demand), for the next period (mode rate)
/// or for ask() (mode off).
class StillPolicy {
public:
    explicit StillPolicy(const TriggerConfig& config) : config_(config) {}

    /// Changes the configuration for the following decisions. If a triggered still has not arrived
    /// yet, the policy continues to wait for it, unless the mode changes to Off.
    void configure(const TriggerConfig& config);

    /// Must be called once per frame. If it returns true, the caller must fire the trigger now.
    /// `stats` are those of the newest frame, at time `now`. FrameStats::explained may be that of
    /// the frame before, at time `before`. If `mayDemand` is false, mode demand requests no new
    /// still, but continues to watch for motion.
    [[nodiscard]] bool decide(Timestamp now, Timestamp before, const FrameStats& stats,
                              bool mayDemand = true);

    /// Requests a still at the next call of decide() at which no still is pending, in every mode.
    void ask() { asked_ = true; }

    /// Must be called if the trigger could not fire, because the previous pulse had not ended. The
    /// next call of decide() requests the trigger again.
    void busy();

    /// Must be called if the trigger could not fire, e.g. because its line is missing. The trigger
    /// is not counted, and is requested again after a second.
    void failed();

    /// Must be called if it is known at time `now` that the still will arrive. It counts as lost
    /// only timeoutS after the last such call.
    void stillIsComing(Timestamp now) { comingAt_ = now; }

    /// Reports that a still is the reference from the next frame on. If the still was exposed
    /// before the last trigger, it counts as a late still of an earlier trigger.
    void stillArrived(Timestamp exposed);

    [[nodiscard]] bool pending() const { return firedAt_ && !arrived_; }
    /// Returns the time of the last trigger while its still is pending.
    [[nodiscard]] std::optional<Timestamp> pendingSince() const {
        return pending() ? firedAt_ : std::nullopt;
    }
    [[nodiscard]] int fired() const { return fired_; }
    /// Returns the number of triggers whose stills did not arrive in time. They may arrive later.
    [[nodiscard]] int timedOut() const { return timedOut_; }
    /// Returns the number of triggers that were repetitions, because the previous trigger's still
    /// was lost. fired() includes the repetitions.
    [[nodiscard]] int repetitions() const { return repetitions_; }

private:
    [[nodiscard]] bool demanded(Timestamp now, Timestamp before, const FrameStats& stats) const;
    [[nodiscard]] bool repeatsAt(Timestamp now);
    void fire(Timestamp now);

    TriggerConfig config_;
    std::optional<Timestamp> still_;
    std::optional<Timestamp> usedSince_;
    std::optional<Timestamp> firedAt_;
    std::optional<Timestamp> comingAt_;
    bool arrived_ = true;  ///< true: the still of the last trigger has arrived or is lost
    bool repeated_ = false;
    std::optional<Timestamp> moved_;  ///< first motion after the last trigger
    bool movedInUse_ = false;         ///< true: the scene moved since the reference was first used
    bool asked_ = false;
    std::optional<Timestamp> due_;
    std::optional<Timestamp> notBefore_;  ///< earliest time of a trigger after two lost stills
    std::optional<Timestamp> retryAt_;    ///< time of the next trigger after failed()
    int fired_ = 0;
    int timedOut_ = 0;
    int repetitions_ = 0;
};

}  // namespace mfar
