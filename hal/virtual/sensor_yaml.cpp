#include "hal/virtual/sensor_yaml.h"

#include "hal/virtual/recording_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <utility>
#include <vector>

namespace mfar {
namespace {

constexpr int kMaxSide = 16384;              // larger than any texture the shaders can use
constexpr double kRotationTolerance = 1e-3;  // files print as few as four digits

int lineOf(const YAML::Mark& mark) {
    return mark.is_null() ? 0 : mark.line + 1;
}

/// Looks values up in one file, every failure with the line of the value.
class Reader {
public:
    explicit Reader(std::filesystem::path file) : file_(std::move(file)) {
        if (!std::filesystem::is_regular_file(file_))
            recordingFault(file_, 0, "is missing, so this camera has no calibration");
        root_ = YAML::LoadFile(file_.string());
        if (!root_.IsMap()) recordingFault(file_, 1, "holds no calibration");
    }

    [[nodiscard]] bool has(const char* key) const { return root_[key].IsDefined(); }
    [[nodiscard]] YAML::Node at(const char* key) const {
        const YAML::Node node = root_[key];
        if (!node.IsDefined() || node.IsNull())
            recordingFault(file_, 0, fmt::format("has no {}", key));
        return node;
    }
    [[nodiscard]] double number(const YAML::Node& node, const char* what) const {
        double value = 0;
        if (!node.IsScalar() || !YAML::convert<double>::decode(node, value))
            fail(node, fmt::format("{} is not a number", what));
        if (!std::isfinite(value)) fail(node, fmt::format("{} is not finite", what));
        return value;
    }
    [[nodiscard]] std::vector<double> numbers(const YAML::Node& node, const char* what) const {
        if (!node.IsSequence()) fail(node, fmt::format("{} is not a list of numbers", what));
        std::vector<double> out;
        for (const YAML::Node& value : node)
            out.push_back(number(value, what));
        return out;
    }
    [[nodiscard]] std::string word(const char* key) const {
        const YAML::Node node = at(key);
        if (!node.IsScalar()) fail(node, fmt::format("{} is not a word", key));
        return node.Scalar();
    }
    [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const {
        recordingFault(file_, lineOf(node.Mark()), what);
    }

private:
    std::filesystem::path file_;
    YAML::Node root_;
};

Size readResolution(const Reader& in) {
    const YAML::Node node = in.at("resolution");
    const std::vector<double> v = in.numbers(node, "resolution");
    if (v.size() != 2) in.fail(node, "resolution needs width and height");
    for (const double side : v)
        if (!(side >= 1 && side <= kMaxSide) || side != std::floor(side))
            in.fail(node, fmt::format("resolution {} is not a whole number from 1 to {}", side,
                                      kMaxSide));
    return {static_cast<int>(v[0]), static_cast<int>(v[1])};
}

void readIntrinsics(const Reader& in, CameraModel& camera) {
    const YAML::Node node = in.at("intrinsics");
    const std::vector<double> v = in.numbers(node, "intrinsics");
    if (v.size() != 4) in.fail(node, "intrinsics need fu, fv, cu, cv");
    for (int i = 0; i < 2; ++i)
        if (!(v[i] > 0 && v[i] < 1e6))
            in.fail(node, fmt::format("focal length {} px is impossible", v[i]));
    const auto near = [](double c, int side) { return c > -side && c < 2.0 * side; };
    if (!near(v[2], camera.size.width) || !near(v[3], camera.size.height))
        in.fail(node, fmt::format("principal point ({}, {}) lies far outside the picture of {}x{}",
                                  v[2], v[3], camera.size.width, camera.size.height));
    camera.fx = v[0];
    camera.fy = v[1];
    camera.cx = v[2];
    camera.cy = v[3];
}

void readDistortion(const Reader& in, CameraModel& camera) {
    const std::string model = in.word("distortion_model");
    if (model == "none") return;
    if (model != "radial-tangential" && model != "radtan")
        in.fail(in.at("distortion_model"),
                fmt::format("distortion_model '{}' is unknown, radial-tangential is read", model));
    const YAML::Node node = in.at("distortion_coefficients");
    const std::vector<double> v = in.numbers(node, "distortion_coefficients");
    if (v.size() != 4 && v.size() != 5)
        in.fail(node, fmt::format("{} distortion_coefficients, 4 or 5 (k1 k2 p1 p2 k3) are needed",
                                  v.size()));
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (std::abs(v[i]) > 1000)
            in.fail(node, fmt::format("distortion coefficient {} is impossible", v[i]));
        camera.distortion[i] = v[i];
    }
}

RigidTransform readTransform(const Reader& in) {
    const YAML::Node matrix = in.at("T_BS");
    const YAML::Node node = matrix.IsMap() ? matrix["data"] : matrix;
    if (!node.IsDefined()) in.fail(matrix, "T_BS has no data");
    const std::vector<double> v = in.numbers(node, "T_BS");
    if (v.size() != 16) in.fail(node, fmt::format("T_BS has {} numbers, not 16", v.size()));
    const Eigen::Matrix4d m =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v.data());
    const Eigen::Matrix3d r = m.topLeftCorner<3, 3>();
    const double skew = (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(skew < kRotationTolerance) || !(r.determinant() > 0))
        in.fail(node, "the upper left part of T_BS is not a rotation");
    if (!m.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), 1e-9))
        in.fail(node, "the last row of T_BS is not 0 0 0 1");
    return {Eigen::Quaterniond(r).normalized(), m.topRightCorner<3, 1>()};
}

double readRate(const Reader& in) {
    if (!in.has("rate_hz")) return 0;
    const YAML::Node node = in.at("rate_hz");
    const double rate = in.number(node, "rate_hz");
    if (!(rate >= 0 && rate <= 10000)) in.fail(node, fmt::format("rate_hz {} is impossible", rate));
    return rate;
}

SensorYaml read(const std::filesystem::path& file) {
    const Reader in(file);
    if (const std::string model = in.word("camera_model"); model != "pinhole")
        in.fail(in.at("camera_model"),
                fmt::format("camera_model '{}' is unknown, pinhole is read", model));
    SensorYaml out;
    out.camera.size = readResolution(in);
    readIntrinsics(in, out.camera);
    readDistortion(in, out.camera);
    out.T_body_sensor = readTransform(in);
    out.rateHz = readRate(in);
    return out;
}

}  // namespace

SensorYaml readSensorYaml(const std::filesystem::path& file) {
    try {
        return read(file);
    } catch (const YAML::BadFile&) {
        recordingFault(file, 0, "cannot be read");
    } catch (const YAML::Exception& e) {
        recordingFault(file, lineOf(e.mark), e.msg);
    }
}

std::string sensorYamlText(const SensorYaml& sensor, std::string_view comment) {
    const CameraModel& c = sensor.camera;
    const Eigen::Matrix3d r = sensor.T_body_sensor.rotation.toRotationMatrix();
    const Eigen::Vector3d& t = sensor.T_body_sensor.translation;
    std::string rows;
    for (int i = 0; i < 3; ++i)
        rows += fmt::format("{}, {}, {}, {},\n         ", r(i, 0), r(i, 1), r(i, 2), t(i));
    return fmt::format("sensor_type: camera\n"
                       "comment: {}\n"
                       "T_BS:\n  cols: 4\n  rows: 4\n  data: [{}0.0, 0.0, 0.0, 1.0]\n"
                       "rate_hz: {}\n"
                       "resolution: [{}, {}]\n"
                       "camera_model: pinhole\n"
                       "intrinsics: [{}, {}, {}, {}] #fu, fv, cu, cv\n"
                       "distortion_model: radial-tangential\n"
                       "distortion_coefficients: [{}]\n",
                       comment, rows, sensor.rateHz, c.size.width, c.size.height, c.fx, c.fy, c.cx,
                       c.cy, fmt::join(c.distortion, ", "));
}

}  // namespace mfar
