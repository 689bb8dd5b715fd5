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
    Size size;  ///< exact size
    /// Frames per second, requested where the camera supports it (FrameDurationLimits), otherwise
    /// the driver's rate. 0: on trigger only; then no drops are counted.
    double rateHz = 30;
    std::optional<double> exposureUs;     ///< fixed exposure; empty: automatic
    std::optional<double> gain;           ///< fixed gain, 1 = no gain; empty: automatic
    std::optional<double> focusDioptres;  ///< fixed focus, 0 = infinity
    /// Further controls by their names in libcamera, including vendors' controls; see
    /// parseControls().
    std::vector<std::pair<std::string, std::string>> controls;
    bool still = false;      ///< configure for single pictures instead of video
    bool allowCrop = false;  ///< accept a sensor mode that shows only a part of the field of view
    unsigned buffers = 6;    ///< number requested; the driver may grant another
};

struct LibcameraCounters {
    std::uint64_t frames = 0;   ///< delivered or ready to be delivered
    std::uint64_t dropped = 0;  ///< see FrameDrops
    std::uint64_t broken = 0;   ///< marked as broken or with too few bytes; never delivered
    std::uint64_t startup = 0;  ///< from before the sensor had settled; never delivered
    /// In the future, in the distant past, or not after the previous frame.
    std::uint64_t badTimes = 0;
    std::uint64_t untimed = 0;    ///< without a timestamp; their arrival time is used
    std::uint64_t restarted = 0;  ///< restarts after the stream had given up waiting for its sensor
    SensorClock::Kind clock = SensorClock::Kind::Monotonic;  ///< the clock that the driver has used
};

/// A camera of libcamera 0.0.3 to 0.7. Several cameras share one libcamera in the process. Picture
/// formats in order of preference, fewest bytes per pixel first: NV12, YUV420, YUYV, XRGB8888,
/// XBGR8888. MJPEG needs the V4L2 camera.
///
/// Chooses the sensor's smallest mode that shows its whole field of view, is not below the size and
/// reaches the rate, if libcamera supports the choice (since 0.2). A picture that shows only a part
/// of the field makes the constructor throw, or next() if only the frames report it.
///
/// A frame's time is libcamera's SensorTimestamp (documented as the start of the first row's
/// exposure) + half the exposure where the camera reports it. A driver that takes the timestamp
/// elsewhere causes a constant offset, which calibration finds. Frames with an implausible time are
/// never delivered. Frames may outlive the camera.
class LibcameraCamera final : public Camera {
public:
    /// Throws std::runtime_error; the message lists the available cameras or formats.
    explicit LibcameraCamera(const LibcameraOptions& options);
    LibcameraCamera(const LibcameraCamera&) = delete;
    LibcameraCamera& operator=(const LibcameraCamera&) = delete;
    ~LibcameraCamera() override;

    [[nodiscard]] CameraInfo info() const override;
    void start() override;
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override { return false; }

    /// Callable from any thread.
    [[nodiscard]] LibcameraCounters counters() const;
    [[nodiscard]] CameraCounters cameraCounters() const override;

private:
    class Stream;
    std::shared_ptr<Stream> stream_;
};

/// The cameras that libcamera currently finds. Throws std::runtime_error.
[[nodiscard]] std::vector<ListedCamera> listLibcameras();

}  // namespace mfar
