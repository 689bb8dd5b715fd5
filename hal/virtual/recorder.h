#pragma once

#include "base/geometry.h"
#include "hal/frame.h"
#include "hal/virtual/background_writer.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace mfar {

struct RecorderOptions {
    /// Largest number of frames, stills and poses that wait to be written.
    int videoBuffers = 16;
    int stillBuffers = 3;
    int poses = 256;
    /// Longest time for which video() and still() wait for a free buffer. A source that waits for
    /// its consumer loses no picture if this is longer than writing a picture takes.
    std::chrono::milliseconds patience{0};
    /// Disk space that must stay free [bytes]. If less is free, the recording ends with an error.
    std::uint64_t leastFreeBytes = 64U << 20;
    /// If the files of all pictures together have become larger than this [bytes], the recording
    /// ends with an error. 0: no limit.
    std::uint64_t mostBytes = 0;
    /// The caller has already added this time to the times of the stills [s]. The recorder only
    /// writes it to cam1/sensor.yaml, because a calibration from this recording must add it to the
    /// clock offset that it finds.
    double stillTimeOffset = 0;
    WatchedThread writer{};
    /// Least interval between two synchronisations of the disk. What was recorded before a
    /// synchronisation is safe from a power cut. A new picture or pose starts a synchronisation if
    /// the last one began at least this long ago.
    std::chrono::milliseconds syncEvery{1000};
};

/// Throws std::runtime_error unless `root` is missing or is an empty folder that can be read.
void requireNoRecording(const std::filesystem::path& root);

/// Writes a recording. video(), still() and pose() copy their argument. If all buffers are in use
/// and none becomes free within RecorderOptions::patience, the picture is dropped and counted. The
/// recording's body coordinates are the coordinates of the video camera.
///
/// data.csv lists a picture only after its file is on the disk. At finish() and every `syncEvery`,
/// first the pictures and then the lists are written to the disk. So a power cut loses only what
/// was recorded after the last synchronisation.
///
/// video(), still() and pose() may be called from three different threads, but each of them from
/// one thread only. They return false if a picture gets no buffer, too many poses wait, the time is
/// negative or not later than the previous one, the size differs from the rig's, a pose is not
/// finite or its quaternion is not a unit quaternion, or a write has failed before. A picture of
/// the rig's size whose view is invalid (requireSound()) throws std::invalid_argument.
class Recorder {
public:
    struct Counts {
        std::uint64_t written = 0;
        std::uint64_t dropped = 0;
    };

    /// Creates the folder, or uses an empty one, and writes the calibration. Throws
    /// std::runtime_error if the folder is not empty or cannot be written, or if `videoRateHz` is
    /// not above 0.
    Recorder(const std::filesystem::path& root, const StereoRig& rig, double videoRateHz,
             const RecorderOptions& options = {});
    ~Recorder();

    bool video(const ImageView& image, Timestamp time) { return picture(video_, image, time); }
    bool still(const ImageView& image, Timestamp time) { return picture(still_, image, time); }
    bool pose(const Pose& pose);
    void addFile(std::string_view name, std::string_view text);

    /// Waits until all accepted pictures and poses are written. Throws std::runtime_error with the
    /// first write error, e.g. that the disk is full. May be called several times.
    void finish();
    [[nodiscard]] std::optional<std::string> error() const;

    [[nodiscard]] Counts videoCounts() const { return video_.counts(); }
    [[nodiscard]] Counts stillCounts() const { return still_.counts(); }
    [[nodiscard]] Counts poseCounts() const { return poses_.counts(); }
    [[nodiscard]] const std::filesystem::path& folder() const { return root_; }

private:
    struct Stream {
        std::filesystem::path folder;
        std::optional<Timestamp> last{};
        std::atomic<std::uint64_t> written{0};
        std::atomic<std::uint64_t> dropped{0};
        std::string rows{};

        [[nodiscard]] Counts counts() const { return {written.load(), dropped.load()}; }
    };
    struct PictureStream : Stream {
        PictureStream(std::filesystem::path where, Size size, int buffers)
            : Stream{std::move(where)}, pool(size, PixelFormat::Rgba8, buffers) {}
        FramePool pool;
    };

    [[nodiscard]] bool accepts(const Stream& stream, Timestamp time) const;
    [[nodiscard]] std::optional<FramePool::Slot> bufferOf(PictureStream& stream) const;
    bool picture(PictureStream& stream, const ImageView& image, Timestamp time);
    void writePicture(PictureStream& stream, const ImageView& picture, Timestamp time);
    void writePose(const Pose& pose);
    void syncWhenDue();
    void sync();
    void checkSpace(std::uintmax_t bytes);

    std::filesystem::path root_;
    RecorderOptions options_;
    // Only the writer's thread uses bytes_ (size of all pictures) and synced_ (start of the last
    // synchronisation).
    std::uintmax_t bytes_ = 0;
    std::optional<std::chrono::steady_clock::time_point> synced_;
    PictureStream video_;
    PictureStream still_;
    Stream poses_;
    std::atomic<int> pendingPoses_{0};
    std::atomic<bool> isSyncing_{false};
    BackgroundWriter syncer_;  // must be declared before writer_, whose thread posts jobs to it
    BackgroundWriter writer_;  // must be the last member, because its thread uses the members above
};

}  // namespace mfar
