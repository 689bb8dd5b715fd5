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

/// A set of devices that belong together, behind a Rig.
class RigSource {
public:
    virtual ~RigSource() = default;
    [[nodiscard]] virtual const StereoRig& geometry() const = 0;
    [[nodiscard]] virtual Camera& video() = 0;
    [[nodiscard]] virtual Camera& still() = 0;
    /// nullptr where stills come by themselves.
    [[nodiscard]] virtual Trigger* trigger() = 0;
    [[nodiscard]] virtual std::string name() const = 0;

    HandOver handOver = HandOver::NewestWins;
    bool hasSensors = false;  ///< its pictures have noise and a rate to keep
    ExitCode failure = ExitCode::Unavailable;
    std::optional<std::uint64_t> videoFrames{};
    std::chrono::nanoseconds stillTimeOffset{0};  ///< to the video's clock
    TagMap tags{};                                ///< where they are known
    /// Empty where poses are not recorded.
    std::function<std::optional<Pose>(Timestamp)> recordedPoses{};
    /// How stills and pulses went together; empty: nobody looked.
    std::function<StillCounters()> matching{};
    /// What is wrong with a device at present, for people; empty: nothing ever is.
    std::function<std::optional<std::string>()> fault{};
};

}  // namespace mfar
