#include "hal/virtual/recorder.h"

#include "base/calibration/sensor_yaml.h"
#include "base/image_layout.h"
#include "base/whole_file.h"
#include "hal/virtual/image_files.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

namespace mfar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kImageHeader = "#timestamp [ns],filename\n";
constexpr const char* kPoseHeader = "#timestamp,p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],"
                                    "q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";

fs::path emptyFolder(const fs::path& root) {
    fs::create_directories(root);
    if (!fs::is_empty(root))
        throw std::runtime_error(root.string() + ": is not empty, a recording needs a new folder");
    return root;
}

void beginCamera(const fs::path& folder, const SensorYaml& sensor, const char* comment) {
    fs::create_directories(folder / "data");
    appendToFile(folder / "sensor.yaml", sensorYamlText(sensor, comment));
    appendToFile(folder / "data.csv", kImageHeader);
}

}  // namespace

Recorder::Recorder(const fs::path& root, const StereoRig& rig, double videoRateHz,
                   const RecorderOptions& options)
    : root_(emptyFolder(root)), options_(options),
      video_(root / "cam0", rig.video.size, options.videoBuffers),
      still_(root / "cam1", rig.still.size, options.stillBuffers),
      poses_{root / "state_groundtruth_estimate0"}, writer_(1, options.writer) {
    if (!(videoRateHz > 0)) throw std::runtime_error("a recording needs a video rate above 0 Hz");
    beginCamera(video_.folder, {rig.video, {}, videoRateHz}, "video sensor, body frame");
    beginCamera(still_.folder, {rig.still, rig.T_still_video.inverse(), 0}, "still sensor");
}

Recorder::~Recorder() = default;

bool Recorder::accepts(const Stream& stream, Timestamp time) const {
    return time.ns >= 0 && (!stream.last || *stream.last < time) && !writer_.error();
}

bool Recorder::picture(PictureStream& stream, const ImageView& image, Timestamp time) {
    if (image.size == stream.pool.size()) requireSound(image, "picture to be recorded");
    std::optional<FramePool::Slot> slot;
    if (image.size == stream.pool.size() && accepts(stream, time))
        slot = stream.pool.acquire(std::chrono::milliseconds(0));
    if (!slot) {
        ++stream.dropped;
        return false;
    }
    stream.last = time;
    // An RGBA buffer is large enough for every format; the writer's thread makes RGB of it.
    const ImageView copy = packInto(slot->data, image);
    const auto loan = std::make_shared<Frame>(stream.pool.lend(*slot, time));
    writer_.post([this, &stream, loan, copy] {
        const std::string name = fmt::format("{}.png", loan->time().ns);
        const fs::path file = stream.folder / "data" / name;
        checkSpace(copy.stride * copy.size.height);
        savePng(file, copy);
        bytes_ += fs::file_size(file);
        appendToFile(stream.folder / "data.csv", fmt::format("{},{}\n", loan->time().ns, name));
        ++stream.written;
    });
    return true;
}

bool Recorder::pose(const Pose& pose) {
    const RigidTransform& T = pose.T_world_video;
    const bool valid = T.translation.allFinite() && std::abs(T.rotation.norm() - 1) < 1e-3;
    if (!valid || pendingPoses_ >= options_.poses || !accepts(poses_, pose.time)) {
        ++poses_.dropped;
        return false;
    }
    poses_.last = pose.time;
    ++pendingPoses_;
    writer_.post([this, pose] {
        --pendingPoses_;
        writePose(pose);
        ++poses_.written;
    });
    return true;
}

void Recorder::addFile(std::string_view name, std::string_view text) {
    writer_.post([file = root_ / name, text = std::vector<std::uint8_t>(text.begin(), text.end())] {
        writeWholeFile(file, text);
    });
}

void Recorder::checkSpace(std::uintmax_t bytes) {
    if (fs::space(root_).available < options_.leastFreeBytes + bytes)
        throw std::runtime_error(fmt::format("{}: less than {} MB are free on the disk",
                                             root_.string(), options_.leastFreeBytes >> 20));
    if (options_.mostBytes > 0 && bytes_ > options_.mostBytes)
        throw std::runtime_error(fmt::format("{}: has become longer than {} MB", root_.string(),
                                             options_.mostBytes >> 20));
}

void Recorder::writePose(const Pose& pose) {
    const fs::path file = poses_.folder / "data.csv";
    if (poses_.written == 0) {
        fs::create_directories(poses_.folder);
        appendToFile(file, kPoseHeader);
    }
    const Eigen::Vector3d& t = pose.T_world_video.translation;
    const Eigen::Quaterniond& q = pose.T_world_video.rotation;
    appendToFile(file, fmt::format("{},{},{},{},{},{},{},{}\n", pose.time.ns, t.x(), t.y(), t.z(),
                                   q.w(), q.x(), q.y(), q.z()));
}

void Recorder::finish() {
    writer_.drain();
}

}  // namespace mfar
