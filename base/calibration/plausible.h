#pragma once

#include "base/calibration/yaml_reader.h"
#include "base/geometry.h"

#include <optional>
#include <string_view>
#include <vector>

/// Functions that read parts of a calibration, for all file formats. They refuse implausible values
/// (plausible_ranges.h) with a CalibrationError that names the value's line.
namespace mfar::plausible {

/// Returns the picture size. It must equal `wanted` if that is set.
[[nodiscard]] Size size(const YamlReader& in, const YAML::Node& node, double width, double height,
                        std::optional<Size> wanted = {});
/// Sets fx, fy, cx, cy from `values`. `camera.size` must be set already.
void setIntrinsics(const YamlReader& in, const YAML::Node& node, const Eigen::Vector4d& values,
                   CameraModel& camera);
/// Sets fx, fy, cx, cy from a 3x3 camera matrix, whose skew must be 0. `camera.size` must be set
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
/// Refuses an implausible distance between the cameras. `T` is the transform between them [m].
void checkBaseline(const YamlReader& in, const YAML::Node& node, const RigidTransform& T);
/// Returns the message of checkBaseline(), or nothing if the distance is plausible.
[[nodiscard]] std::optional<std::string> baselineFault(const RigidTransform& T);
/// Reads a frame rate [Hz]. Rate 0 means that the sensor takes pictures on trigger only.
[[nodiscard]] double rate(const YamlReader& in, const YAML::Node& node, const char* what);
[[nodiscard]] double timeOffset(const YamlReader& in, const YAML::Node& node, const char* what);
/// Returns a message if the time offset [s] is implausible. `what` names the offset.
[[nodiscard]] std::optional<std::string> timeOffsetFault(double offset, const char* what);
/// Refuses the document if timeOffsetFault() has a message.
void requireTimeOffset(const YamlReader& in, const YAML::Node& node, double offset,
                       const char* what);

}  // namespace mfar::plausible
