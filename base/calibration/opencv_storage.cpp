#include "base/calibration/plausible.h"
#include "base/calibration/rig_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

namespace mfar::rig_formats {
namespace {

// Key names used by OpenCV's samples (M1 D1), by its interactive tools and by other programs.
// {} stands for 1 (video camera) or 2 (still camera).
constexpr std::array kMatrixKeys{"M{}", "K{}", "camera_matrix{}", "camera_matrix_{}",
                                 "cameraMatrix{}"};
constexpr std::array kDistortionKeys{"D{}",
                                     "distortion{}",
                                     "distortion_{}",
                                     "distortion_coefficients{}",
                                     "distortion_coefficients_{}",
                                     "distCoeffs{}",
                                     "dist_coeffs{}",
                                     "dist_coeffs_{}"};
constexpr std::array kSizeKeys{"image_size{}", "image_size_{}", "imageSize{}"};

template <std::size_t N>
std::optional<YAML::Node> find(const YamlReader& in, const std::array<const char*, N>& keys,
                               int camera) {
    for (const char* const key : keys)
        if (const auto name = fmt::format(fmt::runtime(key), camera); in.has(name.c_str()))
            return in.at(name.c_str());
    return std::nullopt;
}

template <std::size_t N>
YAML::Node need(const YamlReader& in, const std::array<const char*, N>& keys, int camera) {
    if (auto node = find(in, keys, camera)) return *node;
    in.fail("has no key " + fmt::format(fmt::runtime(keys[0]), camera));
}

std::optional<Size> readSize(const YamlReader& in, int camera, std::optional<Size> wanted) {
    std::optional<YAML::Node> node = find(in, kSizeKeys, camera);
    for (const char* const key : {"image_size", "imageSize", "size"})
        if (!node && in.has(key)) node = in.at(key);
    if (node) {
        const std::vector<double> v = in.numbers(*node, "the image size");
        if (v.size() != 2) in.fail(*node, "the image size must be [width, height]");
        return plausible::size(in, *node, v[0], v[1], wanted);
    }
    if (!in.has("image_width")) return std::nullopt;
    const YAML::Node width = in.at("image_width"), height = in.at("image_height");
    return plausible::size(in, width, in.number(width, "image_width"),
                           in.number(height, "image_height"), wanted);
}

void checkGuessedSize(const YamlReader& in, const YAML::Node& node, const CameraModel& c) {
    const auto central = [](double at, int side) { return at > 0.3 * side && at < 0.7 * side; };
    if (!central(c.cx, c.size.width) || !central(c.cy, c.size.height))
        in.fail(node,
                fmt::format("the file has no key image_size, and the principal point ({}, {}) "
                            "is far from the middle of the sensor's {}x{} pixels",
                            c.cx, c.cy, c.size.width, c.size.height));
}

CameraModel readCamera(const YamlReader& in, int camera, std::optional<Size> wanted) {
    const char* const name =
        camera == 1 ? "the video's camera matrix" : "the still's camera matrix";
    const YAML::Node matrix = in.data(need(in, kMatrixKeys, camera), name);
    CameraModel out;
    const std::optional<Size> size = readSize(in, camera, wanted);
    if (!size && !wanted)
        in.fail("has no key image_size, so the picture size of this calibration is unknown");
    out.size = size ? *size : *wanted;
    plausible::setCameraMatrix(in, matrix, in.matrix(matrix, 3, 3, name), out);
    if (!size) checkGuessedSize(in, matrix, out);
    const YAML::Node data = in.data(need(in, kDistortionKeys, camera), "the distortion");
    plausible::setDistortion(in, data, in.numbers(data, "the distortion"), out);
    return out;
}

}  // namespace

bool isOpenCv(const YamlReader& in) {
    return find(in, kMatrixKeys, 1) || (in.has("R") && in.has("T"));
}

RigCalibration openCv(const YamlReader& intrinsics, const YamlReader& extrinsics,
                      const WantedSizes& wanted) {
    RigCalibration out;
    out.rig.video = readCamera(intrinsics, 1, wanted.video);
    out.rig.still = readCamera(intrinsics, 2, wanted.still);
    const YAML::Node r = extrinsics.data(extrinsics.at("R"), "R");
    const YAML::Node t = extrinsics.data(extrinsics.at("T"), "T");
    RigidTransform& T = out.rig.T_still_video;
    T.rotation = plausible::rotation(extrinsics, r, extrinsics.matrix(r, 3, 3, "R"), "R");
    T.translation = extrinsics.matrix(t, 3, 1, "T");
    plausible::checkBaseline(extrinsics, t, T);
    return out;
}

}  // namespace mfar::rig_formats
