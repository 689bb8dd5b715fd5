#include "base/calibration/plausible.h"
#include "base/calibration/rig_formats.h"

#include <fmt/format.h>

#include <vector>

namespace mfar::rig_formats {
namespace {

void readChainLens(const YamlReader& in, const YAML::Node& map, CameraModel& camera) {
    const YAML::Node name = in.at(map, "distortion_model");
    const std::string model = in.word(name, "distortion_model");
    if (model == "none") return;
    if (model != "radtan")
        in.fail(name, fmt::format("distortion_model '{}' is not supported; expected radtan or none",
                                  model));
    const YAML::Node node = in.at(map, "distortion_coeffs");
    plausible::setDistortion(in, node, in.numbers(node, "distortion_coeffs"), camera);
}

CameraModel readCamera(const YamlReader& in, const YAML::Node& map, std::optional<Size> wanted) {
    const YAML::Node name = in.at(map, "camera_model");
    if (const std::string model = in.word(name, "camera_model"); model != "pinhole")
        in.fail(name, fmt::format("camera_model '{}' is not supported; expected pinhole", model));
    CameraModel out;
    const YAML::Node resolution = in.at(map, "resolution");
    const std::vector<double> sides = in.numbers(resolution, "resolution");
    if (sides.size() != 2) in.fail(resolution, "resolution must be [width, height]");
    out.size = plausible::size(in, resolution, sides[0], sides[1], wanted);
    const YAML::Node node = in.at(map, "intrinsics");
    const std::vector<double> v = in.numbers(node, "intrinsics");
    if (v.size() != 4) in.fail(node, "intrinsics must be [fu, fv, pu, pv]");
    plausible::setIntrinsics(in, node, {v[0], v[1], v[2], v[3]}, out);
    readChainLens(in, map, out);
    return out;
}

RigidTransform readTransform(const YamlReader& in, const YAML::Node& map, const char* key) {
    const YAML::Node node = in.at(map, key);
    return plausible::transform(in, node, in.matrix(node, 4, 4, key), key);
}

/// Returns T_still_video. It is read from T_cn_cnm1 or computed from both cameras' T_cam_imu.
RigidTransform readExtrinsics(const YamlReader& in, const YAML::Node& video,
                              const YAML::Node& still) {
    const bool direct = still["T_cn_cnm1"].IsDefined();
    const char* key = direct ? "T_cn_cnm1" : "T_cam_imu";
    if (!direct && !still[key].IsDefined())
        in.fail(still, "has no key T_cn_cnm1, the transform from cam0 to cam1");
    const RigidTransform T =
        direct ? readTransform(in, still, key)
               : readTransform(in, still, key) * readTransform(in, video, key).inverse();
    plausible::checkBaseline(in, still[key], T);
    return T;
}

/// Returns the offset [s] that converts the time of a still to the video camera's clock. Kalibr
/// states each camera's offset from the IMU: t_imu = t_camera + timeshift_cam_imu.
double readOffset(const YamlReader& in, const YAML::Node& video, const YAML::Node& still) {
    const char* key = "timeshift_cam_imu";
    const YAML::Node ofVideo = video[key], ofStill = still[key];
    if (!ofVideo.IsDefined() || !ofStill.IsDefined()) return 0;
    const double offset =
        plausible::timeOffset(in, ofStill, key) - plausible::timeOffset(in, ofVideo, key);
    plausible::requireTimeOffset(in, ofStill, offset,
                                 "a timeshift_cam_imu difference between the cameras");
    return offset;
}

}  // namespace

RigCalibration kalibr(const YamlReader& in, const WantedSizes& wanted) {
    const YAML::Node video = in.at("cam0");
    if (!in.has("cam1"))
        in.fail("has no key cam1: a rig needs cam0 (video sensor) and cam1 (still sensor)");
    const YAML::Node still = in.at("cam1");
    RigCalibration out;
    out.rig.video = readCamera(in, video, wanted.video);
    out.rig.still = readCamera(in, still, wanted.still);
    out.rig.T_still_video = readExtrinsics(in, video, still);
    out.stillTimeOffset = readOffset(in, video, still);
    return out;
}

}  // namespace mfar::rig_formats
