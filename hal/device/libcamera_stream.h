#pragma once

#include "hal/device/camera_libcamera.h"
#include "hal/device/libcamera_buffers.h"
#include "hal/device/libcamera_setup.h"
#include "hal/frame_drops.h"

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// What runs behind a LibcameraCamera: requests that go round between libcamera's thread, which
/// completes them, and the users of frames, whose giving back queues them again. Frames hold it
/// weakly, and their memory strongly.
class LibcameraCamera::Stream : public std::enable_shared_from_this<Stream> {
public:
    explicit Stream(const LibcameraOptions& options);
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    ~Stream() = default;
    /// Lets the device go, once. A frame that is given back at this moment may hold the object a
    /// little longer, which must not make it the one to do this.
    void close();

    [[nodiscard]] CameraInfo info() const;
    void start();
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout);
    void stop();
    [[nodiscard]] LibcameraCounters counters() const;

private:
    enum class State : std::uint8_t { Idle, Queued, Ready, Lent };
    struct Slot {
        std::unique_ptr<libcamera::Request> request;
        std::shared_ptr<const MappedPicture> picture;
        State state = State::Idle;
    };
    struct Done {
        std::size_t slot = 0;
        Timestamp time;
        std::chrono::nanoseconds exposure{0};
    };

    void open();
    void allocate();
    void completed(libcamera::Request* request);
    void disconnected();
    [[nodiscard]] bool isSound(const libcamera::FrameMetadata& metadata);
    [[nodiscard]] std::optional<Done> describe(std::size_t slot, libcamera::Request& request,
                                               const libcamera::FrameMetadata& metadata);
    void checkView(const libcamera::ControlList& told);
    void queue(Slot& slot);
    void giveBack(std::size_t slot);
    void lose(const std::string& why);
    void begin();
    void halt();
    void restart();
    void awaitUnplugged();

    LibcameraOptions options_;
    std::shared_ptr<libcamera::CameraManager> manager_;
    std::shared_ptr<libcamera::Camera> camera_;
    std::string id_;  ///< of the camera
    ConfiguredCamera configured_;
    ControlValues controls_;
    std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
    libcamera::Stream* stream_ = nullptr;

    std::mutex lifecycle_;  ///< one start() or stop() at a time; taken before the other
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Slot> slots_;
    std::deque<Done> ready_;
    bool running_ = false;
    bool unplugged_ = false;
    bool givenBack_ = false;  ///< it has cancelled all requests
    bool viewChecked_ = false;
    std::string lost_;       ///< why the device is gone; empty: it is not
    std::string viewFault_;  ///< frames show a part of the field
    LibcameraCounters counters_;
    FrameDrops drops_;
    SensorClock clock_;
    std::optional<Timestamp> last_;  ///< of the frames that were delivered
};

}  // namespace mfar
