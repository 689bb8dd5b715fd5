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
    Size size;  ///< exactly
    /// Frames per second, asked for where the camera can be told (FrameDurationLimits), otherwise
    /// as its driver does. 0: on trigger only, then no drops are counted.
    double rateHz = 30;
    std::optional<double> exposureUs;     ///< fixed, instead of automatic
    std::optional<double> gain;           ///< fixed, 1 = none
    std::optional<double> focusDioptres;  ///< fixed, 0 = infinity
    /// Further controls by the name libcamera knows them by, vendors' ones too; see
    /// parseControls().
    std::vector<std::pair<std::string, std::string>> controls;
    bool still = false;      ///< prepare for single pictures rather than for video
    bool allowCrop = false;  ///< accept a sensor mode that shows a part of the field of view
    unsigned buffers = 6;    ///< asked for; the driver may give others
};

struct LibcameraCounters {
    std::uint64_t frames = 0;     ///< given out or ready to be
    std::uint64_t dropped = 0;    ///< see FrameDrops
    std::uint64_t broken = 0;     ///< with an error or too few bytes, never shown
    std::uint64_t startup = 0;    ///< from before the sensor had settled, never shown
    std::uint64_t badTimes = 0;   ///< of the future, the distant past, or not after the one before
    std::uint64_t untimed = 0;    ///< without a time: that of their arrival is used
    std::uint64_t restarted = 0;  ///< times that it had given up waiting for its sensor
    SensorClock::Kind clock = SensorClock::Kind::Monotonic;  ///< which the driver has used
};

/// A camera of libcamera 0.0.3 to 0.7. Several of them share one libcamera in the process. Picture
/// formats by preference, which is the order of their bytes per pixel: NV12, YUV420, YUYV,
/// XRGB8888, XBGR8888. MJPEG is for the V4L2 camera.
///
/// The sensor's smallest mode is chosen that shows its whole field of view, is not below the size
/// and reaches the rate, where libcamera lets it be chosen (0.2 on); in any case the constructor,
/// or next() where it is only told with frames, throws for a picture that shows a part of it.
///
/// A frame's time is libcamera's SensorTimestamp, by its documentation the start of the exposure of
/// the first row, + half the exposure where the camera tells that; a driver that takes the time
/// elsewhere is off by a constant, which calibration finds. Frames whose time cannot be true are
/// never delivered. Frames may outlive the camera.
class LibcameraCamera final : public Camera {
public:
    /// Throws std::runtime_error that says what there is instead.
    explicit LibcameraCamera(const LibcameraOptions& options);
    LibcameraCamera(const LibcameraCamera&) = delete;
    LibcameraCamera& operator=(const LibcameraCamera&) = delete;
    ~LibcameraCamera() override;

    [[nodiscard]] CameraInfo info() const override;
    void start() override;
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override { return false; }

    /// Any thread.
    [[nodiscard]] LibcameraCounters counters() const;
    [[nodiscard]] CameraCounters cameraCounters() const override;

private:
    class Stream;
    std::shared_ptr<Stream> stream_;
};

/// The cameras that libcamera finds now. Throws std::runtime_error.
[[nodiscard]] std::vector<ListedCamera> listLibcameras();

}  // namespace mfar
