#include "hal/virtual/recording.h"

#include "base/calibration/plausible.h"
#include "base/calibration/sensor_yaml.h"
#include "hal/virtual/png_header.h"
#include "hal/virtual/recording_csv.h"

#include <fmt/format.h>

#include <system_error>

#include <algorithm>
#include <cmath>
#include <string>

namespace mfar {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kLongestPoseGap =
    250'000'000;  // [ns]; in a longer gap, a hand-held camera may turn far
// Tolerance of a quaternion's norm. It is large because some files have only four digits.
constexpr double kUnitTolerance = 1e-3;

/// Estimated memory of one entry of a list [bytes]. The factor 2 is for a vector while it grows;
/// 400 is for the file's path and for temporary strings.
constexpr std::size_t kBytesPerPicture = 2 * sizeof(RecordedImage) + 400,
                      kBytesPerPose = 2 * sizeof(Pose);

class ListMemory {
public:
    explicit ListMemory(std::size_t most) : most_(most), left_(most) {}

    void take(std::size_t bytes, const CsvRow& row) {
        if (bytes > left_)
            row.fail(fmt::format("the lists of this recording take more than {} MB of memory",
                                 most_ >> 20U));
        left_ -= bytes;
    }

private:
    std::size_t most_, left_;
};

void checkIncreasing(const CsvRow& row, Timestamp previous, Timestamp t) {
    if (t == previous) row.fail(fmt::format("timestamp {} occurs twice", t.ns));
    if (t < previous)
        row.fail(
            fmt::format("timestamp {} follows {}; timestamps must increase", t.ns, previous.ns));
}

// Returns true if a file name contains no folder. A recording that was made elsewhere must not
// refer to files outside its own folders.
bool isPlainName(std::string_view name) {
    return !name.empty() && name != "." && name != ".." && name.find('/') == name.npos &&
           name.find('\\') == name.npos && name.find('\0') == name.npos;
}

RecordedImage readImageRow(const CsvRow& row, const fs::path& folder, Size expected) {
    if (row.size() != 2)
        row.fail(fmt::format("found {} columns; expected timestamp and file name", row.size()));
    RecordedImage image{row.time(0), {}};
    if (!isPlainName(row.text(1)))
        row.fail(fmt::format("file name '{}' must not contain a path", row.text(1)));
    image.file = folder / row.text(1);
    Size size;
    try {
        size = pngSize(image.file);
    } catch (const std::exception& e) {
        row.fail(fmt::format("picture {} {}", image.file.string(), e.what()));
    }
    if (size != expected)
        row.fail(fmt::format("picture {} is {}x{}, but sensor.yaml says {}x{}", image.file.string(),
                             size.width, size.height, expected.width, expected.height));
    return image;
}

/// Visits all rows. An invalid last row is ignored if a power cut may have truncated it.
void forEachWholeRow(const fs::path& file, const std::function<void(const CsvRow&)>& visit) {
    forEachCsvRow(file, [&](const CsvRow& row) {
        try {
            visit(row);
        } catch (const RecordingError&) {
            if (!row.isTorn()) throw;
        }
    });
}

std::vector<RecordedImage> readImages(const fs::path& camera, Size expected, ListMemory& memory) {
    std::vector<RecordedImage> images;
    forEachWholeRow(camera / "data.csv", [&](const CsvRow& row) {
        RecordedImage image = readImageRow(row, camera / "data", expected);
        if (!images.empty()) checkIncreasing(row, images.back().time, image.time);
        memory.take(kBytesPerPicture, row);
        images.push_back(std::move(image));
    });
    return images;
}

Pose readPoseRow(const CsvRow& row, const RigidTransform& T_body_video) {
    if (row.size() < 8)
        row.fail(fmt::format("found {} columns; expected time, position and quaternion (w x y z)",
                             row.size()));
    RigidTransform T_world_body;
    T_world_body.translation = {row.number(1), row.number(2), row.number(3)};
    const Eigen::Quaterniond q(row.number(4), row.number(5), row.number(6), row.number(7));
    if (!(std::abs(q.norm() - 1) < kUnitTolerance))
        row.fail(fmt::format("the quaternion has length {}; expected 1", q.norm()));
    T_world_body.rotation = q.normalized();
    return {row.time(0), T_world_body * T_body_video};
}

std::vector<Pose> readPoses(const fs::path& folder, const RigidTransform& T_body_video,
                            ListMemory& memory) {
    std::vector<Pose> poses;
    if (!fs::exists(folder)) return poses;
    forEachWholeRow(folder / "data.csv", [&](const CsvRow& row) {
        if (row.isTorn()) return;  // the last number may be truncated and yet look valid
        const Pose pose = readPoseRow(row, T_body_video);
        if (!poses.empty()) checkIncreasing(row, poses.back().time, pose.time);
        memory.take(kBytesPerPose, row);
        poses.push_back(pose);
    });
    return poses;
}

void requireFolder(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        recordingFault(folder, 0,
                       error == std::errc::permission_denied ? error.message()
                                                             : "there is no such folder");
}

std::optional<fs::path> existing(fs::path file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return std::nullopt;
    return file;
}

Recording load(const fs::path& root, std::size_t most) {
    const fs::path videoFolder = root / "cam0", stillFolder = root / "cam1";
    for (const fs::path& folder : {root, videoFolder, stillFolder})
        requireFolder(folder);
    const SensorYaml video = readSensorYaml(videoFolder / "sensor.yaml");
    const SensorYaml still = readSensorYaml(stillFolder / "sensor.yaml");
    if (!(video.rateHz > 0))
        recordingFault(videoFolder / "sensor.yaml", 0, "rate_hz of the video must be above 0");

    Recording out;
    out.root = root;
    out.videoRateHz = video.rateHz;
    out.stillTimeOffset = still.timeOffset - video.timeOffset;
    if (const auto fault = plausible::timeOffsetFault(
            out.stillTimeOffset, "a time_offset difference between the cameras"))
        recordingFault(stillFolder / "sensor.yaml", 0, *fault);
    out.rig = {video.camera, still.camera, still.T_body_sensor.inverse() * video.T_body_sensor};
    if (const auto fault = plausible::baselineFault(out.rig.T_still_video))
        recordingFault(stillFolder / "sensor.yaml", 0, *fault);
    ListMemory memory(most);
    out.video = readImages(videoFolder, video.camera.size, memory);
    if (out.video.empty()) recordingFault(videoFolder / "data.csv", 0, "lists no pictures");
    out.stills = readImages(stillFolder, still.camera.size, memory);
    out.poses = readPoses(root / "state_groundtruth_estimate0", video.T_body_sensor, memory);
    return out;
}

}  // namespace

std::optional<Pose> Recording::poseAt(Timestamp t) const {
    const auto next = std::lower_bound(poses.begin(), poses.end(), t,
                                       [](const Pose& p, Timestamp at) { return p.time < at; });
    if (next == poses.end()) return std::nullopt;
    if (next->time == t) return *next;
    if (next == poses.begin()) return std::nullopt;
    const RigidTransform& a = std::prev(next)->T_world_video;
    const RigidTransform& b = next->T_world_video;
    const Timestamp from = std::prev(next)->time;
    if (next->time.ns - from.ns > kLongestPoseGap) return std::nullopt;
    const double s =
        static_cast<double>(t.ns - from.ns) / static_cast<double>(next->time.ns - from.ns);
    return Pose{t,
                {a.rotation.slerp(s, b.rotation).normalized(),
                 (1 - s) * a.translation + s * b.translation}};
}

std::optional<fs::path> Recording::truthHighRes(Timestamp t) const {
    return existing(root / "truth" / "highres" / fmt::format("{}.png", t.ns));
}

std::optional<fs::path> Recording::truthInverseDepth(Timestamp t) const {
    return existing(root / "truth" / "inverse_depth" / fmt::format("{}.pfm", t.ns));
}

std::optional<fs::path> Recording::truthFlow(Timestamp from, Timestamp to) const {
    return existing(root / "truth" / "flow" / fmt::format("{}_{}.flo", from.ns, to.ns));
}

std::size_t memoryOf(const Recording& recording) {
    return kBytesPerPicture * (recording.video.size() + recording.stills.size()) +
           kBytesPerPose * recording.poses.size();
}

Recording loadRecording(const fs::path& root, std::size_t most) {
    try {
        return load(root, most);
    } catch (const CalibrationError& e) {
        throw RecordingError(e.what());
    } catch (const fs::filesystem_error& e) {
        recordingFault(e.path1(), 0, e.code().message());
    }
}

}  // namespace mfar
