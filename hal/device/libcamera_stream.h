#pragma once

#include "hal/device/camera_libcamera.h"
#include "hal/device/libcamera_buffers.h"
#include "hal/device/libcamera_setup.h"
#include "hal/device/request_cycle.h"
#include "hal/frame_drops.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// The stream of a LibcameraCamera: owns the requests and their memory, and checks completed
/// pictures. Frames hold a weak reference to the stream and a strong one to its memory.
class LibcameraCamera::Stream : public std::enable_shared_from_this<Stream>, private RequestDriver {
public:
    explicit Stream(const LibcameraOptions& options);
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    ~Stream() override = default;
    /// Releases the device, once. A frame that is returned at this moment may keep the object alive
    /// a little longer; the destructor must not release the device then, so close() does.
    void close();

    [[nodiscard]] CameraInfo info() const;
    void begin() { cycle_.start(); }
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout);
    void end() { cycle_.stop(); }
    [[nodiscard]] LibcameraCounters counters() const;

private:
    struct Slot {
        std::unique_ptr<libcamera::Request> request;
        std::shared_ptr<const MappedPicture> picture;
    };

    void start() override;
    [[nodiscard]] int queue(std::size_t slot) override;
    void prepareStop() override;
    void stop() override;
    void open();
    void allocate();
    void completed(libcamera::Request* request);
    void disconnected();
    [[nodiscard]] std::optional<RequestCycle::Done> judge(std::size_t slot,
                                                          libcamera::Request& request);
    [[nodiscard]] bool isSound(const libcamera::FrameMetadata& metadata);
    [[nodiscard]] std::optional<RequestCycle::Done>
    describe(std::size_t slot, libcamera::Request& request,
             const libcamera::FrameMetadata& metadata);
    void checkView(const libcamera::ControlList& told);

    LibcameraOptions options_;
    std::shared_ptr<libcamera::CameraManager> manager_;
    std::shared_ptr<libcamera::Camera> camera_;
    std::string id_;  ///< the camera's id
    ConfiguredCamera configured_;
    ControlValues controls_;
    std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
    libcamera::Stream* stream_ = nullptr;
    std::vector<Slot> slots_;
    RequestCycle cycle_{*this};
    bool controlsDue_ = false;  ///< controls are sent with the next request
    std::atomic<bool> unplugged_{false};

    mutable std::mutex mutex_;  ///< locked after the cycle's mutex
    bool viewChecked_ = false;
    std::string viewFault_;  ///< set when frames show only a part of the field
    LibcameraCounters counters_;
    FrameDrops drops_;
    SensorClock clock_;
    std::optional<Timestamp> last_;  ///< time of the last delivered frame
};

}  // namespace mfar
