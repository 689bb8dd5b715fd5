#pragma once

#include "base/calibration/yaml_reader.h"
#include "base/geometry.h"

#include <optional>
#include <string_view>
#include <vector>

/// These functions read parts of a calibration, whatever its file format. They refuse implausible
/// values (plausible_ranges.h) with a CalibrationError that names the line of the value.
namespace mfar::plausible {

/// Returns the picture size. If `wanted` is set, another size is refused.
[[nodiscard]] Size size(const YamlReader& in, const YAML::Node& node, double width, double height,
                        std::optional<Size> wanted = {});
/// Sets fx, fy, cx, cy from `values`. `camera.size` must be set already.
void setIntrinsics(const YamlReader& in, const YAML::Node& node, const Eigen::Vector4d& values,
                   CameraModel& camera);
/// Sets fx, fy, cx, cy from a 3x3 camera matrix. The skew must be 0. `camera.size` must be set
/// already.
void setCameraMatrix(const YamlReader& in, const YAML::Node& node, const Eigen::Matrix3d& matrix,
                     CameraModel& camera);
/// Sets k1 k2 p1 p2 and, if `values` has a fifth element, k3. Further elements must be zero. The
/// camera's intrinsics must be set already.
void setDistortion(const YamlReader& in, const YAML::Node& node, const std::vector<double>& values,
                   CameraModel& camera);
/// Returns the rotation and the translation [m] of a 4x4 matrix. `what` names the matrix in
/// messages.
[[nodiscard]] RigidTransform transform(const YamlReader& in, const YAML::Node& node,
                                       const Eigen::Matrix4d& matrix, const char* what);
[[nodiscard]] Eigen::Quaterniond rotation(const YamlReader& in, const YAML::Node& node,
                                          const Eigen::Matrix3d& matrix, const char* what);
/// Refuses an implausible distance between the video camera and the still camera. `T`: the
/// transform between them; its translation is in metres.
void checkBaseline(const YamlReader& in, const YAML::Node& node, const RigidTransform& T);
/// Reads a frame rate [Hz]; 0: the sensor takes pictures on trigger only.
[[nodiscard]] double rate(const YamlReader& in, const YAML::Node& node, const char* what);
/// Reads the offset of the still camera's clock [s], see RigCalibration.
[[nodiscard]] double timeOffset(const YamlReader& in, const YAML::Node& node, const char* what);

}  // namespace mfar::plausible
