#include "daemon/objects_config.h"

#include "daemon/toml_reader.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace mfar {
namespace {

constexpr std::array<std::pair<std::string_view, VirtualShape>, 3> kShapes = {
    {{"box", VirtualShape::Box}, {"sphere", VirtualShape::Sphere}, {"quad", VirtualShape::Quad}}};
constexpr double kLeastSize = 0.001, kMostSize = 100, kFarthest = 1000;  // [m]

std::optional<std::string> lengthFault(std::span<const double> wxyz) {
    constexpr double kTolerance = 0.01;
    double square = 0;
    for (const double part : wxyz)
        square += part * part;
    if (std::abs(std::sqrt(square) - 1) < kTolerance) return std::nullopt;
    return "must be a quaternion [w, x, y, z] of length 1";
}

VirtualObject readObject(TomlReader& file, const std::string& prefix) {
    VirtualObject out;
    out.size.setConstant(0.1);
    file.choice<VirtualShape>(prefix + "shape", out.shape, kShapes);
    file.numbers(prefix + "size", {out.size.data(), 3}, kLeastSize, kMostSize);
    RigidTransform& T = out.T_world_object;
    file.numbers(prefix + "position", {T.translation.data(), 3}, -kFarthest, kFarthest);
    std::array<double, 4> wxyz{1, 0, 0, 0};
    file.numbers(prefix + "orientation", wxyz, -1, 1, lengthFault);
    T.rotation = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
    // One colour alone is that of the whole.
    Eigen::Vector3d first = Eigen::Vector3d::Constant(-1);
    file.numbers(prefix + "colour", {first.data(), 3}, 0, 1);
    if (first.x() >= 0) out.colours.fill(first.cast<float>());
    Eigen::Vector3d second = out.colours[1].cast<double>();
    file.numbers(prefix + "second_colour", {second.data(), 3}, 0, 1);
    out.colours[1] = second.cast<float>();
    file.integer(prefix + "squares", out.squares, 1, 256);
    return out;
}

}  // namespace

void readObjects(TomlReader& file, std::vector<VirtualObject>& objects) {
    for (const std::string& prefix : file.sections("objects", kMostObjects))
        objects.push_back(readObject(file, prefix));
}

}  // namespace mfar
