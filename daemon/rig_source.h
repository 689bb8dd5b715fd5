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

class RigSource {
public:
    virtual ~RigSource() = default;
    [[nodiscard]] virtual const StereoRig& geometry() const = 0;
    [[nodiscard]] virtual Camera& video() = 0;
    [[nodiscard]] virtual Camera& still() = 0;
    [[nodiscard]] virtual Trigger* trigger() = 0;
    [[nodiscard]] virtual std::string name() const = 0;

    HandOver handOver = HandOver::NewestWins;
    bool hasSensors = false;  ///< true: the cameras are real sensors, see CameraKind::Sensor
    ExitCode failure = ExitCode::Unavailable;
    std::optional<std::uint64_t> videoFrames{};
    /// Offset that must be added to a still's time to get a time on the video camera's clock.
    std::chrono::nanoseconds stillTimeOffset{0};
    /// Offset that was already added to the times of the stills when they were recorded.
    std::chrono::nanoseconds recordedTimeOffset{0};
    TagMap tags{};
    /// Returns the recorded pose at a point in time. Not set without recorded poses.
    std::function<std::optional<Pose>(Timestamp)> recordedPoses{};
    /// Returns counters of the trigger pulses and of the stills that match them. Not set without a
    /// trigger line.
    std::function<StillCounters()> matching{};
    /// Returns the current fault of a device, or nothing. Not set if this source cannot have
    /// faults.
    std::function<std::optional<std::string>()> fault{};
};

}  // namespace mfar
