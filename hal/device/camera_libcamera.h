#pragma once

#include "hal/camera.h"
#include "hal/device/camera_selection.h"
#include "hal/device/sensor_clock.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

struct LibcameraOptions {
    CameraWish camera;
    Size size;  ///< the exact picture size
    /// Frame rate [Hz]. It is requested if the camera has the control FrameDurationLimits;
    /// otherwise the driver chooses the rate. 0: the camera takes pictures on trigger only, and
    /// drops are not counted.
    double rateHz = 30;
    std::optional<double> exposureUs;     ///< fixed exposure; not set: automatic
    std::optional<double> gain;           ///< fixed gain, 1 = no gain; not set: automatic
    std::optional<double> focusDioptres;  ///< fixed focus, 0 = infinity; not set: camera's default
    /// Further controls: for each, libcamera's or the vendor's name and the value. See
    /// parseControls().
    std::vector<std::pair<std::string, std::string>> controls;
    bool still = false;      ///< configure the camera for single pictures instead of video
    bool allowCrop = false;  ///< accept pictures that show only a part of the field of view
    unsigned buffers = 6;    ///< requested number of buffers; the driver may choose another
};

struct LibcameraCounters {
    std::uint64_t frames = 0;   ///< frames delivered or ready to be delivered
    std::uint64_t dropped = 0;  ///< see FrameDrops
    std::uint64_t broken = 0;   ///< frames marked as broken or with too few bytes; not delivered
    std::uint64_t startup = 0;  ///< frames taken before the sensor had settled; not delivered
    /// Frames whose timestamp is in the future, too old, or not later than the previous frame's.
    std::uint64_t badTimes = 0;
    std::uint64_t untimed = 0;    ///< frames without a timestamp; their arrival time is used
    std::uint64_t restarted = 0;  ///< restarts after the driver cancelled all requests
    SensorClock::Kind clock = SensorClock::Kind::Monotonic;  ///< the clock of the timestamps
};

/// A camera that is driven through libcamera (0.0.3 to 0.7). All cameras of the process share one
/// libcamera manager. The picture formats are, in order of preference: NV12, YUV420, YUYV,
/// XRGB8888, XBGR8888. The first of these have the fewest bytes per pixel. For MJPEG, use
/// CameraV4l2.
///
/// Since libcamera 0.2, the sensor mode can be chosen. LibcameraCamera uses the smallest mode that
/// shows the whole field of view, is at least as large as the picture and reaches the frame rate.
/// If pictures would show only a part of the field of view, the constructor throws. If this is
/// known only from the frames, next() throws.
///
/// The time of a frame is libcamera's SensorTimestamp (documented as the start of the first row's
/// exposure) plus half the exposure, if the camera reports the exposure. If a driver takes the
/// timestamp at another moment, times have a constant offset, which the calibration finds. Frames
/// with an implausible time are not delivered. Frames may outlive the camera.
class LibcameraCamera final : public Camera {
public:
    /// Throws std::runtime_error whose message lists the available cameras or formats.
    explicit LibcameraCamera(const LibcameraOptions& options);
    LibcameraCamera(const LibcameraCamera&) = delete;
    LibcameraCamera& operator=(const LibcameraCamera&) = delete;
    ~LibcameraCamera() override;

    [[nodiscard]] CameraInfo info() const override;
    void start() override;
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override { return false; }

    /// Returns the counters of frames. Thread-safe.
    [[nodiscard]] LibcameraCounters counters() const;
    [[nodiscard]] CameraCounters cameraCounters() const override;

private:
    class Stream;
    std::shared_ptr<Stream> stream_;
};

/// Returns the cameras that libcamera currently finds. Throws std::runtime_error.
[[nodiscard]] std::vector<ListedCamera> listLibcameras();

}  // namespace mfar
