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
    Ok,        ///< pictures are shown, all that was asked for is done
    Degraded,  ///< something is missing, and somebody works on it or waits for it
    Stalled,   ///< the picture stands still: only a new start helps
};

[[nodiscard]] std::string_view name(HealthState state);

/// The state of mfard: one record for the service manager, the log and mfarctl.
struct Health {
    HealthState state = HealthState::Ok;
    std::string cause{};                  ///< in words, without times; empty where all is well
    double sinceS = 0;                    ///< how long this state has had this cause [s]
    std::optional<double> pictureAgeS{};  ///< of the last picture; nothing before the first
    std::string thread{};                 ///< that hangs; empty: none
    bool isDevice = false;                ///< the cause is a device that is being opened again

    /// The service manager may be told that mfard is alive.
    [[nodiscard]] bool isAlive() const { return state != HealthState::Stalled; }
};

/// "the capture thread hangs (stalled for 5.2 s, last picture 5.3 s ago)", "ok"
[[nodiscard]] std::string sentence(const Health& health);
/// Kind and camera of the log message about this health.
[[nodiscard]] Subject subjectOf(const Health& health);
[[nodiscard]] nlohmann::ordered_json healthJson(const Health& health);

/// What the health is judged by, all of the same moment.
struct Observed {
    Timestamp now;
    std::vector<Heartbeats::Late> late{};
    std::optional<Heartbeats::Waiting> waiting{};
    std::optional<std::string> fault{};    ///< of a device that is being opened again
    std::optional<std::string> gpu{};      ///< what is wrong with it
    std::optional<std::string> display{};  ///< why not all pictures are shown or written
    std::optional<Timestamp> repeats{};    ///< the video camera's picture, since when; else nothing
    std::optional<Timestamp> lastPicture{};
    std::optional<Timestamp> lastBanner{};  ///< the last picture once more, with the fault over it
    std::optional<Timestamp> started{};     ///< since when there could be pictures
    double rateHz = 0;                      ///< at which pictures are to come; 0: unknown
    int patience = 1;                       ///< of all limits, see kFirstPatience
};

/// Judges, and remembers since when it has been so. Used by one thread.
///
/// What hangs counts before what is missing, as only that needs another process. A banner counts as
/// a picture only as long as there is a fault, that is a device which somebody tries to open again,
/// and no thread hangs: a driver that does not return has nobody who tries.
class HealthRecord {
public:
    [[nodiscard]] Health judge(const Observed& seen);

private:
    Health last_{};
    Timestamp since_{};
};

}  // namespace mfar
