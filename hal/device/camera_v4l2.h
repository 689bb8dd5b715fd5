#pragma once

#include "hal/camera.h"
#include "hal/device/camera_selection.h"
#include "hal/device/jpeg_decoder.h"
#include "hal/device/v4l2_controls.h"
#include "hal/device/v4l2_stream.h"
#include "hal/frame_drops.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

struct CameraV4l2Options {
    CameraWish device;  ///< path ("/dev/video0"), card name or bus
    V4l2Wish wish;
    /// Number of driver buffers; values outside 2 to 32 are clamped. It must be larger than the
    /// number of pictures that callers hold at a time.
    int buffers = 6;
    /// Added to the driver's timestamps. If the driver takes the timestamp at the end of a frame,
    /// set this to the sensor's readout time with a minus sign.
    std::chrono::nanoseconds timeOffset{0};
    /// Names and values of controls, set in this order before the stream starts, see
    /// V4l2Controls::set().
    std::vector<std::pair<std::string, std::string>> controls{};
};

/// A camera that is driven through V4L2 directly: a USB camera, the kernel's test driver vivid, or
/// a board's camera that libcamera does not support.
///     CameraV4l2 camera({.device = {"/dev/video0"}, .wish = {{640, 480}, 30}});
///     camera.start();
///     while (auto frame = camera.next(500ms)) ...
/// Frames may outlive the camera. They use the driver's buffers without a copy, except in two
/// cases: JPEG is decoded into separate buffers, and pictures are copied if the driver grants fewer
/// buffers than requested and fewer than four. When the users of a frame have released it, the next
/// call of next() gives its buffer back to the driver.
///
/// Frame::time() is the driver's timestamp (start of the exposure or end of the frame) plus
/// timeOffset, shifted by half the exposure towards its middle. The exposure is known only if it is
/// not automatic and the camera has the control exposure_time_absolute or exposure_absolute. An
/// unknown exposure counts as 0. Broken or incomplete pictures and those with an implausible
/// timestamp are counted and not delivered.
///
/// The constructor throws std::runtime_error, e.g. if the camera is not found or busy, if it does
/// not offer the size, or if a control is refused. next() throws DeviceLost if the device is lost;
/// then a new CameraV4l2 must be created.
class CameraV4l2 final : public Camera {
public:
    explicit CameraV4l2(const CameraV4l2Options& options, V4l2Api& api = kernelV4l2());
    CameraV4l2(const CameraV4l2&) = delete;
    CameraV4l2& operator=(const CameraV4l2&) = delete;
    ~CameraV4l2() override;

    [[nodiscard]] CameraInfo info() const override { return info_; }
    void start() override;
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override { return false; }

    [[nodiscard]] const V4l2Controls& controls() const { return *controls_; }
    [[nodiscard]] CameraCounters cameraCounters() const override;
    [[nodiscard]] std::vector<std::string> takeWarnings() override;

private:
    enum class Wait { Picture, Buffer, Nothing, Trouble };
    [[nodiscard]] Wait wait(std::chrono::steady_clock::time_point until) const;
    [[nodiscard]] std::optional<Frame> frameOf(const V4l2Filled& filled);
    [[nodiscard]] std::optional<Frame> copyOf(const ImageView& view, Timestamp time);
    [[nodiscard]] bool isWhole(const V4l2Filled& filled) const;
    [[nodiscard]] std::optional<Timestamp> timeOf(const V4l2Filled& filled);
    [[nodiscard]] std::chrono::nanoseconds manualExposure() const;
    [[nodiscard]] std::chrono::nanoseconds readExposure() const;
    std::nullopt_t refuse(std::uint64_t CameraCounters::* why);
    void count(std::uint64_t CameraCounters::* what);

    CameraV4l2Options options_;
    V4l2Layout layout_;
    CameraInfo info_;
    std::shared_ptr<V4l2Stream> stream_;
    std::unique_ptr<V4l2Controls> controls_;
    std::unique_ptr<JpegDecoder> decoder_;
    std::optional<FramePool> copies_;
    OwnedFd wake_;  // eventfd, readable after stop()
    std::atomic<bool> running_{false};
    std::chrono::nanoseconds exposure_{0};
    std::optional<Timestamp> last_;
    FrameDrops drops_;
    mutable std::mutex countsMutex_;
    CameraCounters counts_;
    std::vector<std::string> warnings_;
};

/// Returns the CameraInfo::name that a CameraV4l2 with this wish would have now. Throws
/// std::runtime_error if there is no such device.
[[nodiscard]] std::string chosenV4l2(const CameraWish& wish, V4l2Api& api = kernelV4l2());

}  // namespace mfar
