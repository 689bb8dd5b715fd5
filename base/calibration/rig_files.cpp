#include "base/calibration/rig_files.h"

#include "base/calibration/camera_info.h"
#include "base/calibration/plausible.h"
#include "base/calibration/rig_formats.h"
#include "base/calibration/sensor_yaml.h"
#include "base/whole_file.h"

#include <fmt/format.h>

#include <system_error>

#include <array>
#include <fstream>
#include <string>

namespace mfar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRigFile = "rig.yaml";

/// Returns the path of a file that rig.yaml names. The name must not contain a folder, because a
/// calibration must not refer to files outside its own folder.
fs::path neighbour(const YamlReader& in, const char* key) {
    const YAML::Node node = in.at(key);
    const fs::path name = in.word(node, key);
    if (name.empty() || name != name.filename() || name == "." || name == "..")
        in.fail(node,
                fmt::format("{} must name a file in the folder of this file, without a path", key));
    return in.file().parent_path() / name;
}

RigCalibration readOwn(const YamlReader& in, const WantedSizes& wanted) {
    RigCalibration out;
    out.rig.video = readCameraInfo(neighbour(in, "video"), wanted.video);
    out.rig.still = readCameraInfo(neighbour(in, "still"), wanted.still);
    const YAML::Node T = in.at("T_still_video");
    out.rig.T_still_video =
        plausible::transform(in, T, in.matrix(T, 4, 4, "T_still_video"), "T_still_video");
    plausible::checkBaseline(in, T, out.rig.T_still_video);
    if (in.has("still_time_offset"))
        out.stillTimeOffset =
            plausible::timeOffset(in, in.at("still_time_offset"), "still_time_offset");
    return out;
}

RigCalibration readEuroc(const fs::path& video, const fs::path& still, const WantedSizes& wanted) {
    const SensorYaml v = readSensorYaml(video, wanted.video);
    const SensorYaml s = readSensorYaml(still, wanted.still);
    // A time on a camera's own clock plus the camera's time_offset is a time on the clock that both
    // cameras share. A still's time plus stillTimeOffset is a time on the video camera's clock.
    RigCalibration out{{v.camera, s.camera, s.T_body_sensor.inverse() * v.T_body_sensor},
                       s.timeOffset - v.timeOffset};
    readYaml(still, [&](const YamlReader& in) {
        plausible::checkBaseline(in, in.at("T_BS"), out.rig.T_still_video);
        if (in.has("time_offset"))
            plausible::requireTimeOffset(in, in.at("time_offset"), out.stillTimeOffset,
                                         "a time_offset difference between the cameras");
    });
    return out;
}

// Returns false if the path is not a regular file, or if this user may not enter its folder.
bool isFile(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

/// Like isFile(), but throws if the path cannot be looked up. Otherwise, a file in a folder that
/// this user may not enter would be reported as missing.
bool hasFile(const fs::path& path) {
    std::error_code error;
    if (fs::is_regular_file(path, error)) return true;
    if (error && error != std::errc::no_such_file_or_directory &&
        error != std::errc::not_a_directory)
        calibrationFault(path, 0, error.message());
    return false;
}

RigCalibration readFolder(const fs::path& folder, const WantedSizes& wanted) {
    if (hasFile(folder / kRigFile)) return loadRig(folder / kRigFile, wanted);
    if (hasFile(folder / "cam0" / "sensor.yaml"))
        return readEuroc(folder / "cam0" / "sensor.yaml", folder / "cam1" / "sensor.yaml", wanted);
    calibrationFault(folder, 0, "contains neither rig.yaml nor cam0/sensor.yaml");
}

RigCalibration readOne(const YamlReader& in, const WantedSizes& wanted) {
    if (in.has("T_still_video")) return readOwn(in, wanted);
    if (in.has("cam0")) return rig_formats::kalibr(in, wanted);
    if (rig_formats::isOpenCv(in)) return rig_formats::openCv(in, in, wanted);
    if (in.has("camera_matrix") || in.has("camera_model"))
        in.fail("describes only one camera: a rig needs both cameras and T_still_video");
    in.fail("is not a calibration in a known format (rig.yaml, Kalibr camchain, OpenCV, EuRoC)");
}

RigCalibration readTwo(const fs::path& first, const fs::path& second, const WantedSizes& wanted) {
    RigCalibration out;
    bool euroc = false;
    readYaml(first, [&](const YamlReader& a) {
        readYaml(second, [&](const YamlReader& b) {
            euroc = a.has("T_BS") && b.has("T_BS");
            if (euroc) return;
            if (!rig_formats::isOpenCv(a) || !rig_formats::isOpenCv(b))
                a.fail(fmt::format("cannot be combined with {}; expected two sensor.yaml "
                                   "files, or the intrinsics and the extrinsics file of OpenCV",
                                   second.string()));
            out =
                a.has("R") ? rig_formats::openCv(b, a, wanted) : rig_formats::openCv(a, b, wanted);
        });
    });
    return euroc ? readEuroc(first, second, wanted) : out;
}

void refuseXml(const fs::path& file) {
    std::ifstream in(file);
    if (in.peek() == '<')
        calibrationFault(file, 1,
                         "is XML, which is not supported: OpenCV's FileStorage writes YAML into a "
                         "file named *.yml");
}

std::string rigText(const RigCalibration& c) {
    const Eigen::Matrix3d r = c.rig.T_still_video.rotation.toRotationMatrix();
    const Eigen::Vector3d& t = c.rig.T_still_video.translation;
    std::string rows;
    for (int i = 0; i < 3; ++i)
        rows += fmt::format("  - [{}, {}, {}, {}]\n", r(i, 0), r(i, 1), r(i, 2), t(i));
    return fmt::format(
        "# The pose of the video and still sensor relative to each other.\n"
        "video: video.yaml  # ROS camera_info, beside this file\n"
        "still: still.yaml\n"
        "# Video camera coordinates -> still camera coordinates, metres.\n"
        "T_still_video:\n{}  - [0.0, 0.0, 0.0, 1.0]\n"
        "# Seconds. A still's time plus this offset is its time on the video's clock.\n"
        "still_time_offset: {}\n",
        rows, c.stillTimeOffset);
}

}  // namespace

RigCalibration loadRig(std::span<const fs::path> paths, const WantedSizes& wanted) {
    for (const fs::path& path : paths)
        if (isFile(path)) refuseXml(path);
    if (paths.size() == 2) return readTwo(paths[0], paths[1], wanted);
    if (paths.size() != 1)
        throw CalibrationError("a calibration consists of one or two files, or of one folder");
    std::error_code unreadable;
    if (fs::is_directory(paths[0], unreadable)) return readFolder(paths[0], wanted);
    RigCalibration out;
    readYaml(paths[0], [&](const YamlReader& in) { out = readOne(in, wanted); });
    return out;
}

RigCalibration loadRig(const fs::path& path, const WantedSizes& wanted) {
    return loadRig(std::span(&path, 1), wanted);
}

void saveRig(const fs::path& folder, const RigCalibration& calibration) {
    fs::create_directories(folder);
    const std::string video = cameraInfoText(calibration.rig.video, "video");
    const std::string still = cameraInfoText(calibration.rig.still, "still");
    const std::string rig = rigText(calibration);
    writeWholeFiles(std::array{NewFile{folder / "video.yaml", video},
                               NewFile{folder / "still.yaml", still},
                               NewFile{folder / kRigFile, rig}});
}

}  // namespace mfar
