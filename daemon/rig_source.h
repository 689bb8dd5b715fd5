#pragma once

#include "base/geometry.h"
#include "daemon/exit_code.h"
#include "daemon/mailbox.h"
#include "hal/camera.h"
#include "hal/still_matcher.h"
#include "hal/trigger.h"
#include "pipeline/track/tag_map.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace mfar {

/// A set of devices that belong together; Rig wraps it.
class RigSource {
public:
    virtual ~RigSource() = default;
    [[nodiscard]] virtual const StereoRig& geometry() const = 0;
    [[nodiscard]] virtual Camera& video() = 0;
    [[nodiscard]] virtual Camera& still() = 0;
    /// nullptr where stills are not triggered.
    [[nodiscard]] virtual Trigger* trigger() = 0;
    [[nodiscard]] virtual std::string name() const = 0;

    HandOver handOver = HandOver::NewestWins;
    bool hasSensors = false;  ///< pictures have noise, and a rate to keep
    ExitCode failure = ExitCode::Unavailable;
    std::optional<std::uint64_t> videoFrames{};
    std::chrono::nanoseconds stillTimeOffset{0};  ///< still's time + offset = video's time
    TagMap tags{};                                ///< empty: unknown
    /// Empty without recorded poses.
    std::function<std::optional<Pose>(Timestamp)> recordedPoses{};
    /// Counters of the matching of stills to pulses; empty: no matching.
    std::function<StillCounters()> matching{};
    /// Present fault of a device, in words; empty: this source has no faults.
    std::function<std::optional<std::string>()> fault{};
};

}  // namespace mfar
