// Fuzzes calibrations in all formats, given as a folder, as single files, and as pairs of files.
#include "base/calibration/camera_info.h"
#include "base/calibration/rig_files.h"
#include "tests/fuzz/file_bundle.h"
#include "tests/fuzz/target.h"

#include <cmath>

namespace {

using namespace mfar;

void requireSound(const CameraModel& camera) {
    test::requireThat(camera.size.width > 0 && camera.size.height > 0,
                      "an accepted camera has no picture size");
    test::requireThat(camera.fx > 0 && camera.fy > 0,
                      "an accepted camera has no positive focal length");
    const Eigen::Vector2d corner(camera.size.width - 1, camera.size.height - 1);
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), corner})
        test::requireThat(camera.unproject(p).allFinite(),
                          "a corner of the picture has no finite ray");
}

void load(std::span<const std::filesystem::path> paths) {
    try {
        const RigCalibration out = loadRig(paths, {Size{640, 480}, Size{2304, 1728}});
        requireSound(out.rig.video);
        requireSound(out.rig.still);
        test::requireThat(out.rig.T_still_video.translation.norm() <= 2,
                          "the accepted distance between the cameras is above 2 m");
        test::requireThat(std::isfinite(out.stillTimeOffset),
                          "the accepted time offset of the stills is not finite");
    } catch (const CalibrationError&) {
        return;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::string> kNames{
        "rig.yaml",         "video.yaml", "still.yaml", "cam0/sensor.yaml",
        "cam1/sensor.yaml", "one.yaml",   "two.yaml"};
    const test::FileBundle bundle(data, size, kNames);
    load(std::span(&bundle.folder(), 1));
    for (const auto& file : bundle.files())
        load(std::span(&file, 1));
    if (bundle.files().size() >= 2) load(std::span(bundle.files()).first(2));
    return 0;
}
