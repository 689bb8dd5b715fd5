#pragma once

#include "daemon/health.h"
#include "daemon/stats.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace mfar {

struct RunDescription {
    std::string renderer;
    std::string source;
    std::string display;
    std::string mode;
    /// Number of frames of the recording that is played.
    std::optional<std::uint64_t> plannedFrames;
    std::optional<double> plannedSeconds;
    std::string poses;
    std::string engine{};
    double videoRateHz = 0;                          ///< expected rate of pictures [Hz]; 0: unknown
    std::optional<std::uint64_t> plannedPictures{};  ///< pictures to show
};

/// Returns the status line. It has a progress bar if the end of the run is planned, and the health
/// if it is not Ok. `elapsedS`: time since mfard was ready [s].
[[nodiscard]] std::string statusLine(const Counted& counted, const RunDescription& run,
                                     double elapsedS, const Health& health = {});

/// `displayFault`: Counted::displayFault after the first picture. If it is set, the picture was
/// drawn but not shown.
[[nodiscard]] std::string firstPictureLine(const ProcessUse& use,
                                           const std::optional<std::string>& displayFault = {});

/// Returns the last line of the log. `seconds` [s] and `fps` [1/s] measure the time from the first
/// to the last picture.
[[nodiscard]] std::string endLine(std::uint64_t pictures, double seconds, double fps,
                                  const std::string& reason);

/// Returns the states of the cameras as JSON, with the keys "video" and "still".
[[nodiscard]] nlohmann::ordered_json cameraStatus(const Counted& counted);

/// Returns the results of the run as JSON. Shares and confidences are in [0, 1]. The key of each
/// time names its unit.
[[nodiscard]] nlohmann::ordered_json summary(const Counted& counted, const RunDescription& run,
                                             const std::string& exitReason, int exitCode);

}  // namespace mfar
