#pragma once

#include "base/calibration/calibration_error.h"
#include "base/geometry.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace mfar {

/// The calibration of a board.
struct RigCalibration {
    StereoRig rig;
    double stillTimeOffset = 0;  ///< [s] time of a still + offset = time on the video's clock
};

/// Picture sizes of the sensors; a calibration of another size is refused. Empty: any size.
struct WantedSizes {
    std::optional<Size> video, still;
};

/// Reads a calibration, usually from one path; its content determines the format:
///   - rig.yaml as saveRig() writes it, or a folder with one;
///   - a Kalibr camchain, cam0 = video, cam1 = still;
///   - OpenCV FileStorage (YAML): M1 D1 M2 D2 R T and their long names, camera 1 = video, in one
///     file or in two (intrinsics, extrinsics). Where it has no size, the wanted one is taken;
///   - EuRoC sensor.yaml: those of video and still, or the folder with cam0/ and cam1/.
/// Throws CalibrationError ("file:line: fault"): a file is missing, the size differs, values are
/// NaN, singular or implausible, or the lens model is not supported.
[[nodiscard]] RigCalibration loadRig(std::span<const std::filesystem::path> paths,
                                     const WantedSizes& wanted = {});
[[nodiscard]] RigCalibration loadRig(const std::filesystem::path& path,
                                     const WantedSizes& wanted = {});

/// Writes video.yaml and still.yaml (ROS camera_info) and rig.yaml, which names both and holds the
/// transform between the sensors; each file completely or not at all. Creates a missing folder.
/// Throws std::runtime_error.
void saveRig(const std::filesystem::path& folder, const RigCalibration& calibration);

}  // namespace mfar
