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
    Size size;
    /// Frame rate [Hz], requested if the camera has the control FrameDurationLimits. 0: the camera
    /// takes pictures only when it is triggered, so drops are counted from frame numbers only.
    double rateHz = 30;
    /// Names and values of controls, see NamedValues. A fixed exposure (ExposureTime), gain or
    /// focus ends its automatic mode, see withManualModes().
    std::vector<std::pair<std::string, std::string>> controls;
    bool still = false;  ///< true: single pictures instead of video
    bool allowCrop = false;
    unsigned buffers = 6;  ///< 2 to 64
};

struct LibcameraCounters {
    std::uint64_t frames = 0;
    std::uint64_t dropped = 0;
    /// The following five counters are explained in CameraCounters (`restarted` as `restarts`).
    std::uint64_t broken = 0;
    std::uint64_t startup = 0;
    std::uint64_t badTimes = 0;
    std::uint64_t untimed = 0;
    std::uint64_t restarted = 0;
    SensorClock::Kind clock = SensorClock::Kind::Monotonic;
};

/// A camera that is driven through libcamera (0.0.3 to 0.7). All cameras of the process share one
/// libcamera manager. Frames may outlive the camera. The picture formats are, in order of
/// preference: NV12, YUV420, YUYV, XRGB8888, XBGR8888. For MJPEG, use CameraV4l2.
///
/// Since libcamera 0.2, the sensor mode can be chosen. LibcameraCamera uses the smallest mode that
/// shows the whole field of view (not required if LibcameraOptions::allowCrop is set), is at least
/// as large as the picture and reaches the frame rate. If there is none, libcamera chooses the
/// mode. If pictures show only a part of the field of view, the constructor or next() throws,
/// unless LibcameraOptions::allowCrop is set.
///
/// The time of a frame is libcamera's SensorTimestamp (documented as the start of the first row's
/// exposure) plus half the exposure. Drivers that take the timestamp at another moment cause a
/// constant offset, which the calibration finds.
class LibcameraCamera final : public Camera {
public:
    /// Throws std::runtime_error. If the camera is not found or its formats are not supported, the
    /// message lists the cameras or formats.
    explicit LibcameraCamera(const LibcameraOptions& options);
    LibcameraCamera(const LibcameraCamera&) = delete;
    LibcameraCamera& operator=(const LibcameraCamera&) = delete;
    ~LibcameraCamera() override;

    [[nodiscard]] CameraInfo info() const override;
    void start() override;
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override { return false; }

    [[nodiscard]] LibcameraCounters counters() const;
    [[nodiscard]] CameraCounters cameraCounters() const override;

private:
    class Stream;
    std::shared_ptr<Stream> stream_;
};

[[nodiscard]] std::vector<ListedCamera> listLibcameras();

/// Returns the CameraInfo::name that a LibcameraCamera with this wish would have now. Throws
/// std::runtime_error if there is no such camera.
[[nodiscard]] std::string chosenLibcamera(const CameraWish& wish);

}  // namespace mfar
