#pragma once

#include "base/heartbeats.h"
#include "daemon/cameras_config.h"
#include "daemon/rig_source.h"
#include "hal/device/trigger_gpiod.h"
#include "hal/reopening_camera.h"
#include "hal/triggered_stills.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// The geometry of two cameras without a calibration: pinholes with a field of view of 60 degrees,
/// the still sensor 14 mm next to the video sensor. Enough to enlarge the video by matching in both
/// dimensions; poses and depth need a calibration.
[[nodiscard]] StereoRig nominalRig(Size video, Size still);

[[nodiscard]] TriggerOptions triggerOptions(const TriggerLineConfig& line);

/// Two cameras of this board and the line that triggers the second. A camera that is not connected
/// is waited for.
class CamerasSource final : public RigSource {
public:
    /// `hearts` watches the threads that open the cameras, and must outlive this. Throws Failure
    /// for an invalid calibration and a missing trigger line.
    CamerasSource(const CamerasConfig& config, Heartbeats& hearts);

    [[nodiscard]] const StereoRig& geometry() const override { return geometry_; }
    [[nodiscard]] Camera& video() override { return *video_; }
    [[nodiscard]] Camera& still() override;
    [[nodiscard]] Trigger* trigger() override { return triggered_.get(); }
    [[nodiscard]] std::string name() const override;

private:
    [[nodiscard]] std::optional<std::string> whatIsWrong() const;

    CamerasConfig config_;
    StereoRig geometry_;
    std::unique_ptr<ReopeningCamera> video_;
    std::unique_ptr<ReopeningCamera> freeStill_;       ///< set without a trigger line
    std::unique_ptr<TriggeredStillCamera> triggered_;  ///< set with a trigger line
    const ReopeningCamera* still_ = nullptr;           ///< the camera in one of the two
    std::function<std::optional<std::string>()> triggerFault_{};
};

}  // namespace mfar
