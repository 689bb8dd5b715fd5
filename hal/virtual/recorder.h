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
    int videoBuffers = 16;  ///< video pictures copied and not yet written, at most
    int stillBuffers = 3;   ///< the same for stills
    int poses = 256;        ///< poses taken and not yet written, at most
    /// So much stays free on the disk: a recording that would need it ends with an error.
    std::uint64_t leastFreeBytes = 64U << 20;
    std::uint64_t mostBytes = 0;  ///< the same for a recording that becomes longer; 0: no limit
    WatchedThread writer{};       ///< which writes; its budget is for one picture
    /// What was written is made safe from a cut of power with the first picture, and then when so
    /// much time has passed since the last time, with the next picture or pose.
    std::chrono::milliseconds syncEvery{1000};
};

/// Writes a recording while the frames it is made of are in use. video(), still() and pose() copy
/// and return at once, whatever the disk does: when their buffers are full the picture is dropped
/// and counted. A data.csv names a picture only after its file is on the disk: at finish() and
/// every `syncEvery` the file system is synchronised, what was written since is named, and the
/// names are synchronised, too. So a recording that was cut off at any moment, also by a cut of
/// power, can be loaded, and lacks at most what came after the last of these points. The body frame
/// B of the recording is the video camera.
///
/// video() is called from one thread, and so are still() and pose(); the three may be different
/// ones. Returned false = not recorded: buffers full, time not after that of the previous picture,
/// another size than the rig's, a pose that is not finite, or an earlier write error.
/// Pictures of any format are taken as they are and become RGB in the writer's thread. A view that
/// is not sound (requireSound()) throws std::invalid_argument.
class Recorder {
public:
    struct Counts {
        std::uint64_t written = 0;
        std::uint64_t dropped = 0;
    };

    /// Creates the folder (or takes an empty one) and writes the calibration. Throws
    /// std::runtime_error when the folder holds anything or cannot be written.
    Recorder(const std::filesystem::path& root, const StereoRig& rig, double videoRateHz,
             const RecorderOptions& options = {});
    /// Like finish(), but errors are lost.
    ~Recorder();

    bool video(const ImageView& image, Timestamp time) { return picture(video_, image, time); }
    bool still(const ImageView& image, Timestamp time) { return picture(still_, image, time); }
    bool pose(const Pose& pose);
    /// A further file of the recording; in place of what it held.
    void addFile(std::string_view name, std::string_view text);

    /// Waits until all that was taken is written. Throws std::runtime_error with the first write
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
        std::string rows{};  ///< not yet in its data.csv; of the writer's thread

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
    /// Makes all files safe, names them, and makes the names safe.
    void sync();
    /// Throws std::runtime_error where no further picture may be written.
    void checkSpace(std::uintmax_t bytes);

    std::filesystem::path root_;
    RecorderOptions options_;
    std::uintmax_t bytes_ = 0;  // of all pictures; of the writer's thread, as the next
    std::optional<std::chrono::steady_clock::time_point> synced_;  // nothing: not yet
    PictureStream video_;
    PictureStream still_;
    Stream poses_;
    std::atomic<int> pendingPoses_{0};
    std::atomic<bool> isSyncing_{false};
    BackgroundWriter syncer_;  // before the other, whose thread posts to it
    BackgroundWriter writer_;  // last: its thread uses all of the above
};

}  // namespace mfar
