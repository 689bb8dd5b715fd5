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

/// A camera at work, as status shows it.
struct CameraState {
    double configuredHz = 0;               ///< 0: on trigger, or as it likes
    double rateHz = 0;                     ///< measured over the last frames; 0: not known
    CameraCounters counters{};             ///< its own, or what its frames tell
    std::uint64_t repeated = 0;            ///< pictures that equal the one before
    std::optional<Timestamp> lastFrame{};  ///< its arrival
    std::optional<Timestamp>
        lastDistinct{};                    ///< of one unlike the one before; nothing: not watched
    std::optional<double> distinctAgeS{};  ///< of that, when somebody asked
    bool repeats = false;                  ///< it has sent the same picture for too long
};

/// A camera's state, as its frames show it.
enum class CameraKind {
    Stored,  ///< nothing: no frame is ever left out
    Live,    ///< frames may be left out
    Sensor,  ///< it also has a rate to keep, and noise, so that no two pictures are equal
};

/// Looks at the frames of one camera: how fast they come, how many are missing where the camera
/// does not count them itself, and whether it shows one picture for ever. One thread.
class CameraWatch {
public:
    /// A rate that is further off for longer is worth a warning.
    static constexpr double kRateTolerance = 0.1;
    static constexpr std::chrono::seconds kRateTime{3};
    /// So is one picture that comes again for longer, and at least so many times.
    static constexpr std::chrono::seconds kRepeatTime{2};
    static constexpr int kRepeats = 3;

    CameraWatch(const CameraInfo& info, CameraKind kind);

    void add(const Frame& frame, Timestamp now);
    /// The camera's own counters, up to now.
    void add(const CameraCounters& counters);

    [[nodiscard]] const CameraState& state() const { return state_; }
    /// Returns the new warnings about the camera, each once.
    [[nodiscard]] std::vector<std::string> takeWarnings();

private:
    void checkRate(Timestamp now);
    void checkRepeats(const Frame& frame, Timestamp now);

    std::string name_;
    CameraKind kind_;
    CameraState state_;
    FrameDrops drops_;
    std::uint64_t frames_ = 0;
    std::optional<Timestamp> wrongSince_;  ///< the rate
    bool rateTold_ = false;
    std::optional<std::uint64_t> checksum_;
    int repeats_ = 0;  ///< of the last picture
    std::vector<std::string> warnings_;
};

/// Covers at most sixteen rows of the first plane, spread over the picture. A sensor's noise makes
/// it differ from picture to picture.
[[nodiscard]] std::uint64_t sparseChecksum(const ImageView& picture);

}  // namespace mfar
