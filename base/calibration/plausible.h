#pragma once

#include "base/calibration/yaml_reader.h"
#include "base/geometry.h"

#include <optional>
#include <string_view>
#include <vector>

/// The parts of a calibration as any file may give them, refused unless they are plausible, see
/// plausible_ranges.h. All throw CalibrationError at the line of the value.
namespace mfar::plausible {

/// Width and height; `wanted`: the only size that is of use.
[[nodiscard]] Size size(const YamlReader& in, const YAML::Node& node, double width, double height,
                        std::optional<Size> wanted = {});
/// fx, fy, cx, cy of a camera whose size is known.
void setIntrinsics(const YamlReader& in, const YAML::Node& node, const Eigen::Vector4d& values,
                   CameraModel& camera);
/// The same from a 3x3 matrix without skew.
void setCameraMatrix(const YamlReader& in, const YAML::Node& node, const Eigen::Matrix3d& matrix,
                     CameraModel& camera);
/// k1 k2 p1 p2 and, if there is a fifth, k3 of a camera whose intrinsics are known. More are
/// accepted where they are zero.
void setDistortion(const YamlReader& in, const YAML::Node& node, const std::vector<double>& values,
                   CameraModel& camera);
/// A rotation and a translation [m], from 4x4 or from its parts.
[[nodiscard]] RigidTransform transform(const YamlReader& in, const YAML::Node& node,
                                       const Eigen::Matrix4d& matrix, const char* what);
[[nodiscard]] Eigen::Quaterniond rotation(const YamlReader& in, const YAML::Node& node,
                                          const Eigen::Matrix3d& matrix, const char* what);
/// Between the two sensors of one board: no more than metres apart.
void checkBaseline(const YamlReader& in, const YAML::Node& node, const RigidTransform& T);
/// [Hz]; 0: on trigger only.
[[nodiscard]] double rate(const YamlReader& in, const YAML::Node& node, const char* what);
/// Of the still's clock [s].
[[nodiscard]] double timeOffset(const YamlReader& in, const YAML::Node& node, const char* what);

}  // namespace mfar::plausible
