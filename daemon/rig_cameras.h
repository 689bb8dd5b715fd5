#pragma once

#include "base/calibration/rig_files.h"
#include "base/heartbeats.h"
#include "daemon/cameras_config.h"
#include "daemon/rig_source.h"
#include "hal/reopening_camera.h"
#include "hal/triggered_stills.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace mfar {

/// Returns the geometry that is assumed for two cameras without a calibration: pinhole cameras with
/// a horizontal field of view of 60 degrees, 14 mm apart. This geometry suffices for matching in
/// two dimensions, but not for poses and depth.
[[nodiscard]] StereoRig nominalRig(Size video, Size still);

/// Returns the configured calibration, or nominalRig() without one. Throws Failure if the
/// calibration is missing, invalid or made for other picture sizes.
[[nodiscard]] RigCalibration calibrationOf(const CamerasConfig& config);

/// The two cameras of this machine, and the GPIO line that triggers the still camera. If a camera
/// is not connected, this object waits for it.
class CamerasSource final : public RigSource {
public:
    /// The threads that open the cameras register at `hearts`, which must outlive this object.
    /// Throws Failure if the calibration is missing or invalid.
    CamerasSource(const CamerasConfig& config, Heartbeats& hearts);

    [[nodiscard]] const StereoRig& geometry() const override { return geometry_; }
    [[nodiscard]] Camera& video() override { return *video_; }
    [[nodiscard]] Camera& still() override;
    [[nodiscard]] Trigger* trigger() override { return triggered_.get(); }
    [[nodiscard]] std::string name() const override;

private:
    [[nodiscard]] std::optional<std::string> whatIsWrong() const;
    /// True if neither camera is named and both have the same driver. Then the picture sizes decide
    /// which camera is the video camera.
    [[nodiscard]] bool choosesBoth() const;
    [[nodiscard]] std::unique_ptr<Camera> openVideo();
    [[nodiscard]] std::unique_ptr<Camera> openStill();

    CamerasConfig config_;
    std::mutex mutex_;
    std::string videoName_;  ///< CameraInfo::name of the camera that was last opened for the video
    StereoRig geometry_;
    std::unique_ptr<ReopeningCamera> video_;
    std::unique_ptr<ReopeningCamera> freeStill_;
    std::unique_ptr<TriggeredStillCamera> triggered_;
    /// The still camera: freeStill_, or a part of triggered_.
    const ReopeningCamera* still_ = nullptr;
    std::function<std::optional<std::string>()> triggerFault_{};
};

}  // namespace mfar
