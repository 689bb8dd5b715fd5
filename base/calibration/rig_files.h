#pragma once

#include "base/calibration/calibration_error.h"
#include "base/geometry.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace mfar {

/// The calibration of the video camera and the still camera.
struct RigCalibration {
    StereoRig rig;
    /// Added to the time of a still [s] to obtain the still's time on the video camera's clock.
    double stillTimeOffset = 0;
};

/// The picture sizes that the sensors deliver. A calibration for another size is refused. If a size
/// is not set, any size is accepted.
struct WantedSizes {
    std::optional<Size> video, still;
};

/// Reads a calibration from one or two paths. The content of the files determines the format:
///   - rig.yaml as saveRig() writes it, or a folder that contains one;
///   - a Kalibr camchain; cam0 is the video camera, cam1 the still camera;
///   - OpenCV FileStorage (YAML) with the keys M1 D1 M2 D2 R T or their long names, e.g.
///     camera_matrix1. There is one file, or one for the intrinsics and one for the extrinsics.
///     Camera 1 is the video camera. If no picture size is stated, the wanted size is used;
///   - two sensor.yaml of EuRoC (video, still), or the folder that contains cam0/ and cam1/.
/// Throws CalibrationError ("file:line: fault") if a file is missing or has another format, the
/// picture size differs from the wanted one, a value is NaN or implausible, a matrix is singular,
/// or the lens model is not supported. Throws CalibrationError, too, if there are no paths or more
/// than two.
[[nodiscard]] RigCalibration loadRig(std::span<const std::filesystem::path> paths,
                                     const WantedSizes& wanted = {});
[[nodiscard]] RigCalibration loadRig(const std::filesystem::path& path,
                                     const WantedSizes& wanted = {});

/// Writes video.yaml and still.yaml (ROS camera_info) and rig.yaml. rig.yaml names the other two
/// and contains the transform between the sensors. No existing file is replaced before all three
/// are on the disk. A missing folder is created. Throws std::runtime_error.
void saveRig(const std::filesystem::path& folder, const RigCalibration& calibration);

}  // namespace mfar
