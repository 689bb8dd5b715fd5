#pragma once

#include "base/time.h"
#include "hal/camera.h"
#include "hal/frame.h"
#include "hal/frame_drops.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// State of a running camera, as `mfarctl status` shows it.
struct CameraState {
    double configuredHz = 0;  ///< 0: triggered or free-running
    double rateHz = 0;        ///< measured over the last frames; 0: unknown
    /// The camera's own counters. If the camera does not count missed frames, CameraWatch counts
    /// delivered and missed frames instead.
    CameraCounters counters{};
    std::uint64_t repeated = 0;  ///< number of pictures equal to the previous one
    std::optional<Timestamp> lastFrame{};
    /// Time of the last picture that differed from the one before it. Set only for
    /// CameraKind::Sensor.
    std::optional<Timestamp> lastDistinct{};
    std::optional<double> distinctAgeS{};  ///< age of that picture [s], set by Stats::count()
    bool repeats = false;  ///< true: the camera has repeated a picture for at least kRepeatTime
};

/// The type of a camera, which decides which checks apply to its frames.
enum class CameraKind {
    Stored,  ///< a lossless source, e.g. a recording: no checks
    Live,    ///< frames may be dropped: missing frames are counted
    Sensor,  ///< like Live, but pictures have noise: rate and repeated pictures are checked, too
};

/// Checks the frames of one camera for a wrong frame rate and for repeated pictures. Counts missing
/// frames if the camera itself does not count them. Only one thread may use it.
class CameraWatch {
public:
    /// The user is warned if the frame rate differs from the configured one by more than
    /// kRateTolerance (0.1: 10 %) for at least kRateTime. This warning comes only once.
    static constexpr double kRateTolerance = 0.1;
    static constexpr std::chrono::seconds kRateTime{3};
    /// The user is warned if the camera repeats a picture at least kRepeats times and for at least
    /// kRepeatTime.
    static constexpr std::chrono::seconds kRepeatTime{2};
    static constexpr int kRepeats = 3;

    CameraWatch(const CameraInfo& info, CameraKind kind);

    void add(const Frame& frame, Timestamp now);
    void add(const CameraCounters& counters);

    [[nodiscard]] const CameraState& state() const { return state_; }
    /// Returns the warnings since the last call.
    [[nodiscard]] std::vector<std::string> takeWarnings();

private:
    void checkRate(Timestamp now);
    void checkRepeats(const Frame& frame, Timestamp now);

    std::string name_;
    CameraKind kind_;
    CameraState state_;
    FrameDrops drops_;
    std::uint64_t frames_ = 0;
    std::optional<Timestamp> wrongSince_;
    bool rateTold_ = false;
    std::optional<std::uint64_t> checksum_;
    int repeats_ = 0;
    std::vector<std::string> warnings_;
};

/// Returns a checksum of at most sixteen rows of the first plane, spread over the picture. Two
/// pictures of a sensor always differ in their noise, so their checksums differ, too.
[[nodiscard]] std::uint64_t sparseChecksum(const ImageView& picture);

}  // namespace mfar
