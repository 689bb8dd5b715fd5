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
    double configuredHz = 0;     ///< configured frame rate; 0: triggered or free-running
    double rateHz = 0;           ///< frame rate measured over the last frames; 0: unknown
    CameraCounters counters{};   ///< the camera's own counters, else counted from its frames
    std::uint64_t repeated = 0;  ///< number of pictures that were equal to the previous one
    std::optional<Timestamp> lastFrame{};  ///< arrival time of the last frame
    /// Time of the last picture that differed from the previous one. Not set: repeated pictures are
    /// not looked for.
    std::optional<Timestamp> lastDistinct{};
    std::optional<double> distinctAgeS{};  ///< age of lastDistinct when the state was queried [s]
    bool repeats = false;  ///< whether the same picture has been sent for more than kRepeatTime
};

/// What a camera is. This decides which checks apply to its frames.
enum class CameraKind {
    Stored,  ///< a recording, none of whose frames is dropped: no checks
    Live,    ///< a source whose frames may be dropped: missing frames are counted
    Sensor,  ///< Live, with a configured rate, and with noise: no two pictures are equal
};

/// Checks the frames of one camera: the frame rate, missing frames if the camera does not count
/// them, and whether the camera repeats one picture. Only one thread may use it.
class CameraWatch {
public:
    /// The user is warned if the frame rate differs from the configured one by more than this share
    /// for longer than this time.
    static constexpr double kRateTolerance = 0.1;
    static constexpr std::chrono::seconds kRateTime{3};
    /// The user is warned if the camera repeats a picture at least this often and for longer than
    /// this time.
    static constexpr std::chrono::seconds kRepeatTime{2};
    static constexpr int kRepeats = 3;

    CameraWatch(const CameraInfo& info, CameraKind kind);

    void add(const Frame& frame, Timestamp now);
    /// Sets the camera's own counters since its start.
    void add(const CameraCounters& counters);

    [[nodiscard]] const CameraState& state() const { return state_; }
    /// Returns the new warnings about the camera. Each is returned once.
    [[nodiscard]] std::vector<std::string> takeWarnings();

private:
    void checkRate(Timestamp now);
    void checkRepeats(const Frame& frame, Timestamp now);

    std::string name_;
    CameraKind kind_;
    CameraState state_;
    FrameDrops drops_;
    std::uint64_t frames_ = 0;
    std::optional<Timestamp> wrongSince_;  ///< time since which the frame rate is wrong
    bool rateTold_ = false;
    std::optional<std::uint64_t> checksum_;
    int repeats_ = 0;  ///< number of consecutive repetitions of the last picture
    std::vector<std::string> warnings_;
};

/// Returns a checksum of at most sixteen rows of the first plane, spread over the picture. Because
/// of a sensor's noise, it differs between any two pictures.
[[nodiscard]] std::uint64_t sparseChecksum(const ImageView& picture);

}  // namespace mfar
