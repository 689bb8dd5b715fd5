#pragma once

#include "hal/device/camera_libcamera.h"
#include "hal/device/libcamera_buffers.h"
#include "hal/device/libcamera_setup.h"
#include "hal/device/picture_times.h"
#include "hal/device/request_cycle.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// The stream of a LibcameraCamera: owns the requests and their memory, and checks the pictures of
/// completed requests. A frame keeps the memory of its picture alive, but not the stream.
class LibcameraCamera::Stream : public std::enable_shared_from_this<Stream>, private RequestDriver {
public:
    explicit Stream(const LibcameraOptions& options);
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    ~Stream() override = default;
    /// Releases the device. Must be called once. The destructor would release the device too late:
    /// a thread that gives back a frame keeps the stream alive until it has done so.
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
    void checkView(const libcamera::ControlList& told);

    LibcameraOptions options_;
    std::shared_ptr<libcamera::CameraManager> manager_;
    std::shared_ptr<libcamera::Camera> camera_;
    std::string id_;
    ConfiguredCamera configured_;
    ControlValues controls_;
    std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
    libcamera::Stream* stream_ = nullptr;
    std::vector<Slot> slots_;
    RequestCycle cycle_{*this};
    bool controlsDue_ = false;
    std::atomic<bool> unplugged_{false};

    mutable std::mutex mutex_;  ///< lock order: first the mutex of cycle_, then mutex_
    bool viewChecked_ = false;
    std::string viewFault_;
    std::optional<PictureTimes> times_;  ///< set by open()
};

}  // namespace mfar
