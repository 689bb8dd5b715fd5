#pragma once

#include "base/calibration/yaml_reader.h"
#include "base/geometry.h"

#include <optional>
#include <string_view>
#include <vector>

/// Reads parts of a calibration from any file format and refuses implausible values, see
/// plausible_ranges.h. All functions throw CalibrationError at the line of the value.
namespace mfar::plausible {

/// Width and height; `wanted`: the only size that is accepted.
[[nodiscard]] Size size(const YamlReader& in, const YAML::Node& node, double width, double height,
                        std::optional<Size> wanted = {});
/// Sets fx, fy, cx, cy. The camera's size must be set before.
void setIntrinsics(const YamlReader& in, const YAML::Node& node, const Eigen::Vector4d& values,
                   CameraModel& camera);
/// As setIntrinsics(), from a 3x3 matrix without skew.
void setCameraMatrix(const YamlReader& in, const YAML::Node& node, const Eigen::Matrix3d& matrix,
                     CameraModel& camera);
/// Sets k1 k2 p1 p2 and, where there is a fifth value, k3. The intrinsics must be set before.
/// Further values must be zero.
void setDistortion(const YamlReader& in, const YAML::Node& node, const std::vector<double>& values,
                   CameraModel& camera);
/// A rotation and a translation [m], from a 4x4 matrix or from its parts.
[[nodiscard]] RigidTransform transform(const YamlReader& in, const YAML::Node& node,
                                       const Eigen::Matrix4d& matrix, const char* what);
[[nodiscard]] Eigen::Quaterniond rotation(const YamlReader& in, const YAML::Node& node,
                                          const Eigen::Matrix3d& matrix, const char* what);
/// Checks that the two sensors of a board are at most metres apart.
void checkBaseline(const YamlReader& in, const YAML::Node& node, const RigidTransform& T);
/// Frame rate [Hz]; 0: the sensor takes pictures on trigger only.
[[nodiscard]] double rate(const YamlReader& in, const YAML::Node& node, const char* what);
/// Offset of the still camera's clock [s].
[[nodiscard]] double timeOffset(const YamlReader& in, const YAML::Node& node, const char* what);

}  // namespace mfar::plausible
