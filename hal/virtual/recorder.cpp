#include "hal/virtual/recorder.h"

#include "base/calibration/sensor_yaml.h"
#include "base/image_layout.h"
#include "base/whole_file.h"
#include "hal/virtual/image_files.h"

#include <fmt/format.h>

#include <system_error>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mfar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kImageHeader = "#timestamp [ns],filename\n";
constexpr const char* kPoseHeader = "#timestamp,p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],"
                                    "q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";

fs::path emptyFolder(const fs::path& root, double videoRateHz) {
    if (!(videoRateHz > 0)) throw std::runtime_error("a recording needs a video rate above 0 Hz");
    std::error_code error;
    fs::create_directories(root, error);
    if (error)
        throw std::runtime_error(
            root.string() + ": the folder of the recording cannot be created: " + error.message());
    requireNoRecording(root);
    return root;
}

void beginCamera(const fs::path& folder, const SensorYaml& sensor, const char* comment) {
    fs::create_directories(folder / "data");
    appendToFile(folder / "sensor.yaml", sensorYamlText(sensor, comment));
    appendToFile(folder / "data.csv", kImageHeader);
}

}  // namespace

void requireNoRecording(const fs::path& root) {
    if (!fs::exists(root)) return;
    if (!fs::is_directory(root))
        throw std::runtime_error(root.string() +
                                 " is not a folder; a recording needs a new or empty folder");
    if (!fs::is_empty(root))
        throw std::runtime_error(root.string() +
                                 ": the folder is not empty; a recording needs a new one");
}

Recorder::Recorder(const fs::path& root, const StereoRig& rig, double videoRateHz,
                   const RecorderOptions& options)
    : root_(emptyFolder(root, videoRateHz)), options_(options),
      video_(root / "cam0", rig.video.size, options.videoBuffers),
      still_(root / "cam1", rig.still.size, options.stillBuffers),
      poses_{root / "state_groundtruth_estimate0"}, syncer_(1, options.writer),
      writer_(1, options.writer) {
    beginCamera(video_.folder, {rig.video, {}, videoRateHz, 0},
                "video sensor; its coordinates are the body coordinates");
    beginCamera(still_.folder, {rig.still, rig.T_still_video.inverse(), 0, options.stillTimeOffset},
                "still sensor");
    // Does not wait for the disk, which may have much unwritten data of other programs.
    syncer_.post([this] { syncFileSystem(root_); });
}

Recorder::~Recorder() {
    writer_.post([this] { sync(); });
}

bool Recorder::accepts(const Stream& stream, Timestamp time) const {
    return time.ns >= 0 && (!stream.last || *stream.last < time) && !error();
}

// The wait also ends after a write error, because the picture would not be written.
std::optional<FramePool::Slot> Recorder::bufferOf(PictureStream& stream) const {
    constexpr std::chrono::milliseconds kPoll{20};
    const auto end = std::chrono::steady_clock::now() + options_.patience;
    std::optional<FramePool::Slot> slot = stream.pool.acquire(std::chrono::milliseconds(0));
    while (!slot && !error() && std::chrono::steady_clock::now() < end)
        slot = stream.pool.acquire(kPoll);
    return slot;
}

bool Recorder::picture(PictureStream& stream, const ImageView& image, Timestamp time) {
    if (image.size == stream.pool.size()) requireSound(image, "picture to be recorded");
    std::optional<FramePool::Slot> slot;
    if (image.size == stream.pool.size() && accepts(stream, time)) slot = bufferOf(stream);
    if (!slot) {
        ++stream.dropped;
        return false;
    }
    stream.last = time;
    // The buffers have four bytes per pixel, enough for every format. The writer's thread converts
    // the copied picture to a PNG's format.
    const ImageView copy = packInto(slot->data, image);
    const auto loan = std::make_shared<Frame>(stream.pool.lend(*slot, time));
    writer_.post([this, &stream, loan, copy] { writePicture(stream, copy, loan->time()); });
    return true;
}

void Recorder::writePicture(PictureStream& stream, const ImageView& picture, Timestamp time) {
    const std::string name = fmt::format("{}.png", time.ns);
    const fs::path file = stream.folder / "data" / name;
    try {
        checkSpace(picture.stride * picture.size.height);
        savePng(file, picture);
    } catch (const std::runtime_error&) {
        // No more pictures will be written, so the last ones are listed now.
        sync();
        throw;
    }
    std::error_code ignored;
    if (const std::uintmax_t size = fs::file_size(file, ignored); !ignored) bytes_ += size;
    stream.rows += fmt::format("{},{}\n", time.ns, name);
    ++stream.written;
    syncWhenDue();
}

void Recorder::syncWhenDue() {
    const auto isDue = [&] {
        return !synced_ || std::chrono::steady_clock::now() - *synced_ >= options_.syncEvery;
    };
    if (!isSyncing_ && isDue()) sync();
}

// A separate thread synchronises the file system. If the writer's thread waited for a slow disk,
// the picture buffers would run out.
void Recorder::sync() {
    synced_ = std::chrono::steady_clock::now();
    isSyncing_ = true;
    std::vector<std::pair<fs::path, std::string>> rows;
    for (Stream* stream : {static_cast<Stream*>(&video_), static_cast<Stream*>(&still_), &poses_})
        if (!stream->rows.empty())
            rows.emplace_back(stream->folder / "data.csv", std::exchange(stream->rows, {}));
    syncer_.post([this, rows = std::move(rows)] {
        const std::shared_ptr<void> atEnd(nullptr, [this](void*) { isSyncing_ = false; });
        syncFileSystem(root_);
        if (rows.empty()) return;
        for (const auto& [file, text] : rows)
            appendToFile(file, text);
        syncFileSystem(root_);
    });
}

std::optional<std::string> Recorder::error() const {
    std::optional<std::string> error = writer_.error();
    return error ? error : syncer_.error();
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
    const std::uintmax_t available = fs::space(root_).available;
    if (available < bytes) throw std::runtime_error(root_.string() + ": the disk is full");
    if (available < options_.leastFreeBytes + bytes)
        throw std::runtime_error(fmt::format("{}: less than {} MB are free on the disk",
                                             root_.string(), options_.leastFreeBytes >> 20));
    if (options_.mostBytes > 0 && bytes_ > options_.mostBytes)
        throw std::runtime_error(fmt::format("{}: the recording has become larger than {} MB",
                                             root_.string(), options_.mostBytes >> 20));
}

void Recorder::writePose(const Pose& pose) {
    if (poses_.written == 0) {
        // The folder and the file are created together, because a recording with the folder alone
        // cannot be read.
        fs::create_directories(poses_.folder);
        appendToFile(poses_.folder / "data.csv", kPoseHeader);
    }
    const Eigen::Vector3d& t = pose.T_world_video.translation;
    const Eigen::Quaterniond& q = pose.T_world_video.rotation;
    poses_.rows += fmt::format("{},{},{},{},{},{},{},{}\n", pose.time.ns, t.x(), t.y(), t.z(),
                               q.w(), q.x(), q.y(), q.z());
    syncWhenDue();
}

void Recorder::finish() {
    writer_.post([this] { sync(); });
    writer_.drain();
    syncer_.drain();
}

}  // namespace mfar
