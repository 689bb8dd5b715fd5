#pragma once

#include "base/calibration/calibration_error.h"
#include "base/geometry.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace mfar {

/// What a calibration says about a board.
struct RigCalibration {
    StereoRig rig;
    double stillTimeOffset = 0;  ///< [s] time of a still + offset = time on the video's clock
};

/// The sizes the sensors give; a calibration of another size is refused. Nothing: any.
struct WantedSizes {
    std::optional<Size> video, still;
};

/// Reads a calibration, one path in the most cases; the format is told from the content.
///   - rig.yaml as saveRig() writes it, or a folder with one;
///   - a Kalibr camchain, cam0 = video, cam1 = still;
///   - OpenCV FileStorage (YAML): M1 D1 M2 D2 R T and their long names, camera 1 = video, in one
///     file or in two (intrinsics, extrinsics). Where it has no size, the wanted one is taken;
///   - EuRoC sensor.yaml: those of video and still, or the folder with cam0/ and cam1/.
/// Throws CalibrationError ("file:line: what"): not there, another size, NaN, singular or
/// implausible values, a lens model that this product does not have.
[[nodiscard]] RigCalibration loadRig(std::span<const std::filesystem::path> paths,
                                     const WantedSizes& wanted = {});
[[nodiscard]] RigCalibration loadRig(const std::filesystem::path& path,
                                     const WantedSizes& wanted = {});

/// Writes video.yaml and still.yaml (ROS camera_info) and rig.yaml, which names them and says how
/// the sensors stand to each other; each complete or not at all. The folder is made if need be.
/// Throws std::runtime_error.
void saveRig(const std::filesystem::path& folder, const RigCalibration& calibration);

}  // namespace mfar
