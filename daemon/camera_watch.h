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

/// State of a running camera, as status shows it.
struct CameraState {
    double configuredHz = 0;               ///< 0: triggered or free-running
    double rateHz = 0;                     ///< measured over the last frames; 0: unknown
    CameraCounters counters{};             ///< reported by the camera, else derived from its frames
    std::uint64_t repeated = 0;            ///< pictures equal to the one before
    std::optional<Timestamp> lastFrame{};  ///< arrival time
    std::optional<Timestamp>
        lastDistinct{};  ///< last picture unlike the one before; nothing: not watched
    std::optional<double> distinctAgeS{};  ///< age of lastDistinct at the time of the query
    bool repeats = false;  ///< the same picture has come for longer than kRepeatTime
};

/// Which checks apply to a camera's frames.
enum class CameraKind {
    Stored,  ///< none: no frame is ever dropped
    Live,    ///< frames may be dropped
    Sensor,  ///< also has a rate to keep, and noise, so that no two pictures are equal
};

/// Checks the frames of one camera: their rate, the number of missing frames where the camera does
/// not count them itself, and whether it repeats one picture. Used by one thread.
class CameraWatch {
public:
    /// A rate that is off by more than this share for longer than this time causes a warning.
    static constexpr double kRateTolerance = 0.1;
    static constexpr std::chrono::seconds kRateTime{3};
    /// A picture that repeats for longer than this time and at least this many times causes a
    /// warning.
    static constexpr std::chrono::seconds kRepeatTime{2};
    static constexpr int kRepeats = 3;

    CameraWatch(const CameraInfo& info, CameraKind kind);

    void add(const Frame& frame, Timestamp now);
    /// The camera's own counters since its start.
    void add(const CameraCounters& counters);

    [[nodiscard]] const CameraState& state() const { return state_; }
    /// Returns the new warnings about the camera, each only once.
    [[nodiscard]] std::vector<std::string> takeWarnings();

private:
    void checkRate(Timestamp now);
    void checkRepeats(const Frame& frame, Timestamp now);

    std::string name_;
    CameraKind kind_;
    CameraState state_;
    FrameDrops drops_;
    std::uint64_t frames_ = 0;
    std::optional<Timestamp> wrongSince_;  ///< since when the rate is wrong
    bool rateTold_ = false;
    std::optional<std::uint64_t> checksum_;
    int repeats_ = 0;  ///< consecutive repetitions of the last picture
    std::vector<std::string> warnings_;
};

/// Checksum of at most sixteen rows of the first plane, spread over the picture. A sensor's noise
/// makes it differ from picture to picture.
[[nodiscard]] std::uint64_t sparseChecksum(const ImageView& picture);

}  // namespace mfar
