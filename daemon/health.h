#pragma once

#include "base/heartbeats.h"
#include "base/time.h"
#include "daemon/message_ids.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

enum class HealthState {
    Ok,        ///< pictures are shown, and everything that is configured works
    Degraded,  ///< something does not work and is being repaired or waited for
    Stalled,   ///< no new pictures: only a restart helps
};

[[nodiscard]] std::string_view name(HealthState state);

/// The state of mfard: one record for the service manager, the log and mfarctl.
struct Health {
    HealthState state = HealthState::Ok;
    std::string cause{};                  ///< in words, without times; empty in state Ok
    double sinceS = 0;                    ///< how long this state has had this cause [s]
    std::optional<double> pictureAgeS{};  ///< of the last picture; nothing before the first
    std::string thread{};                 ///< the thread that hangs; empty: none
    bool isDevice = false;                ///< the cause is a device that is being opened again

    /// True when the watchdog may be fed.
    [[nodiscard]] bool isAlive() const { return state != HealthState::Stalled; }
};

/// "the capture thread hangs (stalled for 5.2 s, last picture 5.3 s ago)", "ok"
[[nodiscard]] std::string sentence(const Health& health);
/// Message id, camera and thread of the log message about this health.
[[nodiscard]] Subject subjectOf(const Health& health);
[[nodiscard]] nlohmann::ordered_json healthJson(const Health& health);

/// Inputs of the judgement, all of the same moment.
struct Observed {
    Timestamp now;
    std::vector<Heartbeats::Late> late{};
    std::optional<Heartbeats::Waiting> waiting{};
    std::optional<std::string> fault{};    ///< of a device that is being reopened
    std::optional<std::string> gpu{};      ///< fault of the GPU
    std::optional<std::string> display{};  ///< why not all pictures are shown or written
    std::optional<Timestamp> repeats{};    ///< since when the video camera's picture repeats
    std::optional<Timestamp> lastPicture{};
    std::optional<Timestamp> lastBanner{};  ///< when the fault was last shown as a banner
    std::optional<Timestamp> started{};     ///< when pictures could have begun
    double rateHz = 0;                      ///< expected rate of pictures; 0: unknown
    int patience = 1;                       ///< factor on all limits, see kFirstPatience
};

/// Judges, and remembers since when the state has had its cause. Used by one thread.
///
/// A thread that hangs ranks before anything that is missing, as only a restart helps then. A
/// banner counts as a new picture only while a device has a fault, that is while mfard tries to
/// reopen it, and no thread hangs: a driver that does not return keeps mfard from trying.
class HealthRecord {
public:
    [[nodiscard]] Health judge(const Observed& seen);

private:
    Health last_{};
    Timestamp since_{};
};

}  // namespace mfar
