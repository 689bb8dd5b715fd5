#include "base/calibration/sensor_yaml.h"

#include "base/calibration/plausible.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace mfar {
namespace {

Eigen::Vector4d readIntrinsics(const YamlReader& in, const YAML::Node& node) {
    const std::vector<double> v = in.numbers(node, "intrinsics");
    if (v.size() != 4) in.fail(node, "intrinsics must be [fu, fv, cu, cv]");
    return {v[0], v[1], v[2], v[3]};
}

void readSensorLens(const YamlReader& in, CameraModel& camera) {
    const YAML::Node name = in.at("distortion_model");
    const std::string model = in.word(name, "distortion_model");
    if (model == "none") return;
    if (model != "radial-tangential" && model != "radtan")
        in.fail(name, fmt::format("distortion_model '{}' is not supported; expected "
                                  "radial-tangential, radtan or none",
                                  model));
    const YAML::Node node = in.at("distortion_coefficients");
    plausible::setDistortion(in, node, in.numbers(node, "distortion_coefficients"), camera);
}

double readRate(const YamlReader& in) {
    if (!in.has("rate_hz")) return 0;
    return plausible::rate(in, in.at("rate_hz"), "rate_hz");
}

SensorYaml readSensor(const YamlReader& in, std::optional<Size> wanted) {
    const YAML::Node name = in.at("camera_model");
    if (const std::string model = in.word(name, "camera_model"); model != "pinhole")
        in.fail(name, fmt::format("camera_model '{}' is not supported; expected pinhole", model));
    SensorYaml out;
    const YAML::Node resolution = in.at("resolution");
    const std::vector<double> sides = in.numbers(resolution, "resolution");
    if (sides.size() != 2) in.fail(resolution, "resolution must be [width, height]");
    out.camera.size = plausible::size(in, resolution, sides[0], sides[1], wanted);
    const YAML::Node intrinsics = in.at("intrinsics");
    plausible::setIntrinsics(in, intrinsics, readIntrinsics(in, intrinsics), out.camera);
    readSensorLens(in, out.camera);
    const YAML::Node data = in.data(in.at("T_BS"), "T_BS");
    out.T_body_sensor = plausible::transform(in, data, in.matrix(data, 4, 4, "T_BS"), "T_BS");
    out.rateHz = readRate(in);
    if (in.has("time_offset"))
        out.timeOffset = plausible::timeOffset(in, in.at("time_offset"), "time_offset");
    return out;
}

}  // namespace

SensorYaml readSensorYaml(const std::filesystem::path& file, std::optional<Size> wanted) {
    SensorYaml out;
    readYaml(file, [&](const YamlReader& in) { out = readSensor(in, wanted); });
    return out;
}

std::string sensorYamlText(const SensorYaml& sensor, std::string_view comment) {
    const CameraModel& c = sensor.camera;
    const Eigen::Matrix3d r = sensor.T_body_sensor.rotation.toRotationMatrix();
    const Eigen::Vector3d& t = sensor.T_body_sensor.translation;
    std::string rows;
    for (int i = 0; i < 3; ++i)
        rows += fmt::format("{}, {}, {}, {},\n         ", r(i, 0), r(i, 1), r(i, 2), t(i));
    const std::string offset =
        sensor.timeOffset == 0
            ? ""
            : fmt::format("time_offset: {} #s, was added to the camera's times\n",
                          sensor.timeOffset);
    return fmt::format("sensor_type: camera\n"
                       "comment: {}\n"
                       "T_BS:\n  cols: 4\n  rows: 4\n  data: [{}0.0, 0.0, 0.0, 1.0]\n"
                       "rate_hz: {}\n"
                       "resolution: [{}, {}]\n"
                       "camera_model: pinhole\n"
                       "intrinsics: [{}, {}, {}, {}] #fu, fv, cu, cv\n"
                       "distortion_model: radial-tangential\n"
                       "distortion_coefficients: [{}]\n"
                       "{}",
                       comment, rows, sensor.rateHz, c.size.width, c.size.height, c.fx, c.fy, c.cx,
                       c.cy, fmt::join(c.distortion, ", "), offset);
}

}  // namespace mfar
