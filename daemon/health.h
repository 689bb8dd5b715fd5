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

/// At the start, a camera that is being opened counts as a fault only after this time [s].
inline constexpr double kOpeningS = 0.5;

enum class HealthState {
    Ok,        ///< pictures are shown, and everything that is configured works
    Degraded,  ///< something does not work; mfard waits for it or tries to repair it
    Stalled,   ///< there are no new pictures, and only a restart helps
};

[[nodiscard]] std::string_view name(HealthState state);

struct Health {
    HealthState state = HealthState::Ok;
    std::string cause{};  ///< empty in state Ok; has no times, so equal causes have equal texts
    double sinceS = 0;    ///< duration of the state with this cause [s]
    std::optional<double> pictureAgeS{};  ///< age of the last picture [s]; not set: there is none
    std::string thread{};
    bool isDevice = false;  ///< true: the cause is a device that is being reopened

    [[nodiscard]] bool isAlive() const { return state != HealthState::Stalled; }
};

/// Returns the health as text: "the video capture thread hangs (stalled for 5.2 s, last picture
/// 5.3 s ago)" or "ok".
[[nodiscard]] std::string sentence(const Health& health);
[[nodiscard]] Subject subjectOf(const Health& health);
[[nodiscard]] nlohmann::ordered_json healthJson(const Health& health);

/// The observations from which the health is judged, all made at the same time.
struct Observed {
    Timestamp now;
    std::vector<Heartbeats::Late> late{};
    std::optional<Heartbeats::Waiting> waiting{};
    std::optional<std::string> fault{};
    std::optional<std::string> gpu{};
    std::optional<std::string> display{};  ///< reason why not all pictures are shown or written
    std::optional<Timestamp> repeats{};  ///< time since which the video camera repeats one picture
    std::optional<Timestamp> lastPicture{};
    std::optional<Timestamp> lastExcuse{};  ///< see Stats::excused()
    std::optional<Timestamp> started{};     ///< time when mfard was ready to make pictures
    double rateHz = 0;                      ///< expected rate of pictures; 0: unknown
    int patience = 1;
};

/// Judges the health, and measures for how long state and cause have been the same. Only one thread
/// may use it.
///
/// A vital thread that hangs is reported before any other fault, because only a restart helps
/// against it. If no vital thread hangs, a known reason for no new picture (see Stats::excused())
/// counts as a new picture. It still counts for a while (at least kStalePicture), because after a
/// device has returned, its first picture is not shown at once.
class HealthRecord {
public:
    [[nodiscard]] Health judge(const Observed& seen);

private:
    Health last_{};
    Timestamp since_{};
};

}  // namespace mfar
