#pragma once

#include "daemon/health.h"
#include "daemon/stats.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace mfar {

/// Description of the run in words; complete after set-up.
struct RunDescription {
    std::string renderer;
    std::string source;
    std::string display;
    std::string mode;
    std::optional<std::uint64_t> plannedFrames;  ///< from the recording or --frames
    std::optional<double> plannedSeconds;        ///< --seconds
    std::string poses;                           ///< origin of the poses
    std::string engine{};                        ///< see describe() in engine_config.h
    double videoRateHz = 0;                      ///< expected rate of pictures; 0: unknown
};

/// The status line: with a progress bar where the end is known, and with the health unless it is
/// Ok. `elapsedS`: since the first frame.
[[nodiscard]] std::string statusLine(const Counted& counted, const RunDescription& run,
                                     double elapsedS, const Health& health = {});

/// "first picture 430 ms after the start, 90 MB resident"
[[nodiscard]] std::string firstPictureLine(const ProcessUse& use);

/// State of the cameras, by name.
[[nodiscard]] nlohmann::ordered_json cameraStatus(const Counted& counted);

/// Results of the run, for programs. Shares and confidences are in [0, 1], times in ms.
[[nodiscard]] nlohmann::ordered_json summary(const Counted& counted, const RunDescription& run,
                                             const std::string& exitReason, int exitCode);

}  // namespace mfar
