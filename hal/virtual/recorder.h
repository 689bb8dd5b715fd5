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
    int videoBuffers = 16;  ///< upper limit of video pictures copied and not yet written
    int stillBuffers = 3;   ///< upper limit of stills copied and not yet written
    int poses = 256;        ///< upper limit of poses not yet written
    /// Disk space that stays free: a recording that would need it ends with an error.
    std::uint64_t leastFreeBytes = 64U << 20;
    std::uint64_t mostBytes = 0;  ///< upper limit of a recording's size; 0: no limit
    WatchedThread writer{};       ///< the writing thread; its budget is for one picture
    /// Interval between syncs to the disk, which protect against a power cut: the first picture
    /// triggers one, later the first picture or pose after this time.
    std::chrono::milliseconds syncEvery{1000};
};

/// Writes a recording while its frames are in use. video(), still() and pose() copy and return at
/// once, regardless of the disk: when their buffers are full the picture is dropped and counted.
/// data.csv lists a picture only after its file is on the disk: at finish() and every `syncEvery`
/// the file system is synchronised, the new pictures are listed, and the lists are synchronised,
/// too. So a recording that was interrupted at any moment, also by a power cut, can be loaded and
/// lacks at most what came after the last sync. The recording's body frame B is the video camera.
/// B of the recording is the video camera.
///
/// video() is called from one thread, still() and pose() likewise; these may be three threads. They
/// return false for what is not recorded: buffers full, time not after the previous picture's, size
/// different from the rig's, a pose that is not finite, or an earlier write error. Pictures of any
/// format are accepted and converted to RGB in the writer's thread. An invalid view
/// (requireSound()) throws std::invalid_argument.
class Recorder {
public:
    struct Counts {
        std::uint64_t written = 0;
        std::uint64_t dropped = 0;
    };

    /// Creates the folder (or uses an empty one) and writes the calibration. Throws
    /// std::runtime_error when the folder is not empty or cannot be written.
    Recorder(const std::filesystem::path& root, const StereoRig& rig, double videoRateHz,
             const RecorderOptions& options = {});
    /// Like finish(), but ignores errors.
    ~Recorder();

    bool video(const ImageView& image, Timestamp time) { return picture(video_, image, time); }
    bool still(const ImageView& image, Timestamp time) { return picture(still_, image, time); }
    bool pose(const Pose& pose);
    /// Writes a further file of the recording, replacing its content.
    void addFile(std::string_view name, std::string_view text);

    /// Waits until everything accepted is written. Throws std::runtime_error with the first write
    /// error of the recording (disk full, folder gone). May be called more than once.
    void finish();
    /// The first write error so far. Thread-safe, never waits.
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
        std::string rows{};  ///< rows not yet in data.csv; used by the writer's thread

        [[nodiscard]] Counts counts() const { return {written.load(), dropped.load()}; }
    };
    struct PictureStream : Stream {
        PictureStream(std::filesystem::path where, Size size, int buffers)
            : Stream{std::move(where)}, pool(size, PixelFormat::Rgba8, buffers) {}
        FramePool pool;
    };

    [[nodiscard]] bool accepts(const Stream& stream, Timestamp time) const;
    bool picture(PictureStream& stream, const ImageView& image, Timestamp time);
    void writePicture(PictureStream& stream, const ImageView& picture, Timestamp time);
    void writePose(const Pose& pose);
    void syncWhenDue();
    /// Synchronises all files, lists them, and synchronises the lists.
    void sync();
    /// Throws std::runtime_error when no further picture may be written.
    void checkSpace(std::uintmax_t bytes);

    std::filesystem::path root_;
    RecorderOptions options_;
    std::uintmax_t bytes_ = 0;  // sum over all pictures; used by the writer's thread, as synced_
    std::optional<std::chrono::steady_clock::time_point> synced_;  // empty: not yet
    PictureStream video_;
    PictureStream still_;
    Stream poses_;
    std::atomic<int> pendingPoses_{0};
    std::atomic<bool> isSyncing_{false};
    BackgroundWriter syncer_;  // declared before writer_, whose thread posts to it
    BackgroundWriter writer_;  // last member: its thread uses all others
};

}  // namespace mfar
