#include "daemon/tools/calibrate/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace mfar::calibration {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kViewsInALine = 4;

std::string viewsOf(const SensorResult& sensor, const char* name) {
    std::string out = fmt::format(
        "{} views: time, corners, RMS reprojection error; \"out\" marks an unused view\n", name);
    const auto first = sensor.views.empty() ? Timestamp{} : sensor.views.front().time;
    int column = 0;
    for (const ViewResult& view : sensor.views) {
        const double at = secondsBetween(first, view.time);
        out += fmt::format("  {:7.2f} s {:4} {:6.3f} px{}", at, view.corners.size(),
                           rms(view.residuals), view.used ? "    " : " out");
        if (++column % kViewsInALine == 0) out += '\n';
    }
    return out + (column % kViewsInALine == 0 ? "" : "\n");
}

std::string cameraText(const SensorResult& sensor, const char* name) {
    const CameraModel& c = sensor.camera;
    const auto used = std::ranges::count_if(sensor.views, &ViewResult::used);
    std::string out = fmt::format(
        "{}: {}x{}, {} views used, {} views left out, RMS reprojection error {:.3f} px\n", name,
        c.size.width, c.size.height, used, static_cast<std::ptrdiff_t>(sensor.views.size()) - used,
        sensor.rms);
    const std::array<double, 4> pinhole{c.fx, c.fy, c.cx, c.cy};
    constexpr std::array<const char*, 9> kNames{"fx", "fy", "cx", "cy", "k1",
                                                "k2", "p1", "p2", "k3"};
    for (int i = 0; i < 4; ++i)
        out += fmt::format("  {} {:9.3f} +- {:.3f} px{}", kNames[i], pinhole[i],
                           sensor.deviations[i], i % 2 == 1 ? "\n" : "    ");
    for (int i = 0; i < 5; ++i)
        if (sensor.deviations[4 + i] > 0)
            out += fmt::format("  {} {:9.5f} +- {:.5f}{}", kNames[4 + i], c.distortion[i],
                               sensor.deviations[4 + i], i % 2 == 1 ? "\n" : "       ");
    return out + (sensor.deviations[8] > 0 ? "\n" : "");
}

}  // namespace

std::string mapText(const Coverage& coverage, const std::string& title) {
    const std::string edge = "+" + std::string(Coverage::kColumns, '-') + "+\n";
    std::string out = title + "\n" + edge;
    for (const std::string& row : coverage.map())
        out += "|" + row + "|\n";
    return out + edge;
}

std::string viewsText(const Calibration& calibration) {
    return viewsOf(calibration.video, "video") + viewsOf(calibration.still, "still");
}

std::string resultText(const Calibration& calibration) {
    const RigidTransform& T = calibration.rig.rig.T_still_video;
    const Eigen::Vector3d& t = T.translation;
    const auto& d = calibration.extrinsicDeviations;
    const double baseline = t.norm();
    const double baselineDeviation =
        baseline > 0 ? (t.cwiseProduct(d.tail<3>()) / baseline).norm() : d.tail<3>().norm();
    std::string out =
        cameraText(calibration.video, "video") + cameraText(calibration.still, "still");
    out += fmt::format(
        "sensors: {:.3f} +- {:.3f} mm apart, rotated by {:.3f} degrees; computed from {} "
        "stills\n",
        1000 * baseline, 1000 * baselineDeviation, Eigen::AngleAxisd(T.rotation).angle() / kDegree,
        calibration.pairs);
    out +=
        fmt::format("  position of the video sensor as seen by the still sensor ({:.3f}, {:.3f}, "
                    "{:.3f}) +- ({:.3f}, {:.3f}, {:.3f}) mm, rotation +- {:.4f} degrees\n",
                    1000 * t.x(), 1000 * t.y(), 1000 * t.z(), 1000 * d[3], 1000 * d[4], 1000 * d[5],
                    d.head<3>().maxCoeff() / kDegree);
    if (calibration.offsetKnown)
        return out + fmt::format(
                         "clocks: add {:.3f} ms to still times to get video times, +- {:.3f} ms\n",
                         1000 * calibration.rig.stillTimeOffset,
                         1000 * calibration.offsetDeviation);
    const double recorded = calibration.rig.stillTimeOffset;
    return out + fmt::format("clocks: the offset of the still's clock was not measured and {}, "
                             "because --max-offset is 0 or the camera moved too little while "
                             "stills were taken\n",
                             recorded == 0
                                 ? "is taken as 0"
                                 : fmt::format("stays {:.3f} ms, the value in the recording",
                                               1000 * recorded));
}

}  // namespace mfar::calibration
