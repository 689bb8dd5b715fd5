#include "base/calibration/plausible.h"

#include "base/calibration/plausible_ranges.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace mfar::plausible {
namespace {

// R counts as a rotation if its determinant is positive and the absolute value of every element of
// R R^T - I is below this. Some files round R to four digits.
constexpr double kRotationTolerance = 1e-3;
// Largest error of project(unproject(pixel)) [px]. A larger error shows that the lens model folds
// over inside the picture.
constexpr double kMaxFoldError = 0.5;

std::string text(const Range& range) {
    const bool hasUnit = std::string_view(range.unit) != "1";
    return fmt::format("{} to {}{}{}", range.least, range.most, hasUnit ? " " : "",
                       hasUnit ? range.unit : "");
}

/// Returns true if the lens model folds over inside the picture, so that several rays map to one
/// pixel. Examines only pixels on the border, because distortion is largest there.
bool foldsInside(const CameraModel& c) {
    const double right = c.size.width - 1, bottom = c.size.height - 1;
    const std::array<Eigen::Vector2d, 8> border{{{0, c.cy},
                                                 {right, c.cy},
                                                 {c.cx, 0},
                                                 {c.cx, bottom},
                                                 {0, 0},
                                                 {right, 0},
                                                 {0, bottom},
                                                 {right, bottom}}};
    for (const Eigen::Vector2d& p : border)
        if (!((c.project(c.unproject(p)) - p).norm() < kMaxFoldError)) return true;
    return false;
}

/// Compares the distance of each corner of the picture from the principal point with and without
/// distortion. Returns the ratio (with / without) that differs most from 1.
double mostUnlikelyCorner(const CameraModel& c) {
    const double right = c.size.width - 1, bottom = c.size.height - 1;
    const Eigen::Vector2d centre(c.cx, c.cy);
    double out = 1;
    const std::array<Eigen::Vector2d, 4> corners{
        {{0, 0}, {right, 0}, {0, bottom}, {right, bottom}}};
    for (const Eigen::Vector2d& p : corners) {
        const Eigen::Vector2d ray = c.unproject(p);
        const double with = (p - centre).norm(),
                     without = std::hypot(c.fx * ray.x(), c.fy * ray.y());
        const double ratio = with > 1 ? with / without : 1;
        if (!(std::abs(std::log(ratio)) <= std::abs(std::log(out)))) out = ratio;
    }
    return out;
}

}  // namespace

Size size(const YamlReader& in, const YAML::Node& node, double width, double height,
          std::optional<Size> wanted) {
    for (const double side : {width, height})
        if (!kSide.holds(side) || side != std::floor(side))
            in.fail(node,
                    fmt::format("resolution {} is not a whole number from {}", side, text(kSide)));
    const Size out{static_cast<int>(width), static_cast<int>(height)};
    if (wanted && out != *wanted)
        in.fail(node,
                fmt::format("is a calibration for {}x{} pixels, but the sensor delivers {}x{}",
                            out.width, out.height, wanted->width, wanted->height));
    return out;
}

void setIntrinsics(const YamlReader& in, const YAML::Node& node, const Eigen::Vector4d& values,
                   CameraModel& camera) {
    for (int i = 0; i < 2; ++i)
        if (!kFocal.holds(values[i] / camera.size.width))
            in.fail(node,
                    fmt::format(
                        "focal length {} px is not plausible for a picture {} px wide; expected {}",
                        values[i], camera.size.width, text(kFocal)));
    if (!kPrincipal.holds(values[2] / camera.size.width) ||
        !kPrincipal.holds(values[3] / camera.size.height))
        in.fail(node,
                fmt::format(
                    "principal point ({}, {}) lies far outside the picture of {}x{}; expected {}",
                    values[2], values[3], camera.size.width, camera.size.height, text(kPrincipal)));
    camera.fx = values[0];
    camera.fy = values[1];
    camera.cx = values[2];
    camera.cy = values[3];
}

void setCameraMatrix(const YamlReader& in, const YAML::Node& node, const Eigen::Matrix3d& matrix,
                     CameraModel& camera) {
    if (!(std::abs(matrix.determinant()) > 1e-9)) in.fail(node, "the camera matrix is singular");
    if (!matrix.row(2).isApprox(Eigen::RowVector3d(0, 0, 1), 1e-9) || matrix(1, 0) != 0)
        in.fail(node, "the camera matrix does not have the form [fx 0 cx, 0 fy cy, 0 0 1]");
    if (std::abs(matrix(0, 1)) > 1e-6 * std::abs(matrix(0, 0)))
        in.fail(node, fmt::format("the camera matrix has a skew of {}; expected 0", matrix(0, 1)));
    setIntrinsics(in, node, {matrix(0, 0), matrix(1, 1), matrix(0, 2), matrix(1, 2)}, camera);
}

void setDistortion(const YamlReader& in, const YAML::Node& node, const std::vector<double>& values,
                   CameraModel& camera) {
    if (values.size() < 4)
        in.fail(node,
                fmt::format("found {} distortion coefficients; expected 4 or 5 (k1 k2 p1 p2 k3)",
                            values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!kCoefficient.holds(values[i]))
            in.fail(node, fmt::format("distortion coefficient {} is not plausible; expected {}",
                                      values[i], text(kCoefficient)));
        if (i < camera.distortion.size())
            camera.distortion[i] = values[i];
        else if (values[i] != 0)
            in.fail(node, fmt::format("distortion coefficient {} is {}; only the first five (k1 k2 "
                                      "p1 p2 k3) may differ from 0",
                                      i + 1, values[i]));
    }
    if (foldsInside(camera))
        in.fail(node, "the distortion is not plausible: it maps several rays to one pixel");
    const double corner = mostUnlikelyCorner(camera);
    if (!kCorner.holds(corner))
        in.fail(node, fmt::format("the distortion multiplies the distance of a picture corner from "
                                  "the principal point by {}; expected {}",
                                  corner, text(kCorner)));
}

Eigen::Quaterniond rotation(const YamlReader& in, const YAML::Node& node,
                            const Eigen::Matrix3d& matrix, const char* what) {
    const double skew =
        (matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(skew < kRotationTolerance) || !(matrix.determinant() > 0))
        in.fail(node, fmt::format("{} is not a rotation matrix", what));
    return Eigen::Quaterniond(matrix).normalized();
}

RigidTransform transform(const YamlReader& in, const YAML::Node& node,
                         const Eigen::Matrix4d& matrix, const char* what) {
    const auto part = fmt::format("the upper left part of {}", what);
    const Eigen::Quaterniond turn = rotation(in, node, matrix.topLeftCorner<3, 3>(), part.c_str());
    if (!matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), 1e-9))
        in.fail(node, fmt::format("the last row of {} is not 0 0 0 1", what));
    return {turn, matrix.topRightCorner<3, 1>()};
}

void checkBaseline(const YamlReader& in, const YAML::Node& node, const RigidTransform& T) {
    if (const std::optional<std::string> fault = baselineFault(T)) in.fail(node, *fault);
}

std::optional<std::string> baselineFault(const RigidTransform& T) {
    const double baseline = T.translation.norm();
    if (kBaseline.holds(baseline)) return std::nullopt;
    return fmt::format(
        "the sensors are {} m apart; expected {}. Is the translation given in metres?", baseline,
        text(kBaseline));
}

double timeOffset(const YamlReader& in, const YAML::Node& node, const char* what) {
    const double offset = in.number(node, what);
    requireTimeOffset(in, node, offset, what);
    return offset;
}

void requireTimeOffset(const YamlReader& in, const YAML::Node& node, double offset,
                       const char* what) {
    if (const std::optional<std::string> fault = timeOffsetFault(offset, what))
        in.fail(node, *fault);
}

std::optional<std::string> timeOffsetFault(double offset, const char* what) {
    if (kTimeOffset.holds(offset)) return std::nullopt;
    return fmt::format("{} of {} s is not plausible; expected {}", what, offset, text(kTimeOffset));
}

double rate(const YamlReader& in, const YAML::Node& node, const char* what) {
    const double value = in.number(node, what);
    if (value != 0 && !kRate.holds(value))
        in.fail(node, fmt::format("{} of {} Hz is not plausible; expected 0 or {}", what, value,
                                  text(kRate)));
    return value;
}

}  // namespace mfar::plausible
