#include "base/calibration/camera_info.h"

#include "base/calibration/plausible.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace mfar {
namespace {

void readInfoLens(const YamlReader& in, CameraModel& camera) {
    const YAML::Node name = in.at("distortion_model");
    const std::string model = in.word(name, "distortion_model");
    if (model != "plumb_bob" && model != "rational_polynomial")
        in.fail(
            name,
            fmt::format(
                "distortion_model '{}' is not supported; expected plumb_bob or rational_polynomial",
                model));
    const YAML::Node node = in.at("distortion_coefficients");
    const YAML::Node data = in.data(node, "distortion_coefficients");
    plausible::setDistortion(in, data, in.numbers(data, "distortion_coefficients"), camera);
}

CameraModel readInfo(const YamlReader& in, std::optional<Size> wanted) {
    CameraModel out;
    const YAML::Node width = in.at("image_width"), height = in.at("image_height");
    out.size = plausible::size(in, width, in.number(width, "image_width"),
                               in.number(height, "image_height"), wanted);
    const YAML::Node data = in.data(in.at("camera_matrix"), "camera_matrix");
    plausible::setCameraMatrix(in, data, in.matrix(data, 3, 3, "camera_matrix"), out);
    readInfoLens(in, out);
    return out;
}

}  // namespace

CameraModel readCameraInfo(const std::filesystem::path& file, std::optional<Size> wanted) {
    CameraModel out;
    readYaml(file, [&](const YamlReader& in) { out = readInfo(in, wanted); });
    return out;
}

std::string cameraInfoText(const CameraModel& camera, std::string_view name) {
    const CameraModel& c = camera;
    const auto matrix = [](std::string_view what, int rows, const std::vector<double>& values) {
        return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: [{}]\n", what, rows,
                           values.size() / rows, fmt::join(values, ", "));
    };
    return fmt::format("image_width: {}\nimage_height: {}\ncamera_name: {}\n", c.size.width,
                       c.size.height, name) +
           matrix("camera_matrix", 3, {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1}) +
           "distortion_model: plumb_bob\n" +
           matrix("distortion_coefficients", 1, {c.distortion.begin(), c.distortion.end()}) +
           matrix("rectification_matrix", 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
           matrix("projection_matrix", 3, {c.fx, 0, c.cx, 0, 0, c.fy, c.cy, 0, 0, 0, 1, 0});
}

}  // namespace mfar
