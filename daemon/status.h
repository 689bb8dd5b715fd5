#pragma once

#include "daemon/health.h"
#include "daemon/stats.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace mfar {

/// What the run is made of, in words; known after set-up.
struct RunDescription {
    std::string renderer;
    std::string source;
    std::string display;
    std::string mode;
    std::optional<std::uint64_t> plannedFrames;  ///< recording or --frames: how many there will be
    std::optional<double> plannedSeconds;        ///< --seconds
    std::string poses;                           ///< where they come from
    std::string engine{};                        ///< see describe() in engine_config.h
    double videoRateHz = 0;                      ///< at which pictures are to come; 0: unknown
};

/// One line for the terminal: with a bar where the end is known, and the health where it is not
/// well. `elapsedS` since the first frame.
[[nodiscard]] std::string statusLine(const Counted& counted, const RunDescription& run,
                                     double elapsedS, const Health& health = {});

/// "first picture 430 ms after the start, 90 MB resident"
[[nodiscard]] std::string firstPictureLine(const ProcessUse& use);

/// What the cameras do, by their names.
[[nodiscard]] nlohmann::ordered_json cameraStatus(const Counted& counted);

/// What the run measured, for programs. Shares and confidences are in [0, 1], times in ms.
[[nodiscard]] nlohmann::ordered_json summary(const Counted& counted, const RunDescription& run,
                                             const std::string& exitReason, int exitCode);

}  // namespace mfar
