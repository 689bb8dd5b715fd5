#pragma once

#include "hal/device/v4l2_formats.h"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace mfar {

/// The driver's report about a buffer that it has filled. Only `index` is validated.
struct V4l2Filled {
    int index = 0;
    std::uint32_t flags = 0;
    std::uint32_t sequence = 0;  ///< number of the frame; numbers of lost frames are skipped
    std::int64_t seconds = 0, microseconds = 0;
    std::array<std::size_t, 3> offset{}, bytes{};
};

/// The memory-mapped buffers of a capture device, allocated once. The driver fills a buffer; then a
/// user holds its picture and returns it. Thread-safe. Users of pictures hold a shared_ptr to this
/// object, so that a picture can be read and returned after the device was closed.
///
/// If a driver hangs, calls of start(), stop(), close(), takeBack() and take() block. giveBack()
/// never blocks, because the thread that processes frames may call it.
class V4l2Stream {
public:
    /// The device's format must already be set. The driver may allocate fewer or more buffers than
    /// requested. Throws std::runtime_error, DeviceLost.
    V4l2Stream(V4l2Device device, const V4l2Layout& layout, int buffers);
    V4l2Stream(const V4l2Stream&) = delete;
    V4l2Stream& operator=(const V4l2Stream&) = delete;
    ~V4l2Stream() { close(); }

    /// Queues every buffer whose picture is not in use and starts the capture. Throws like the
    /// constructor.
    void start();
    /// Stops the capture. May be called again. Errors are ignored, because the device may be lost.
    void stop() noexcept;
    /// Calls stop() and releases the device, so that another program can use it. The memory of
    /// pictures in use stays mapped.
    void close() noexcept;

    /// Returns a filled buffer, which the caller holds until giveBack(). Returns nothing if no
    /// buffer is filled or the stream does not run. Throws DeviceLost if no more buffers will come.
    [[nodiscard]] std::optional<V4l2Filled> take();
    /// Returns a buffer to this object. The next takeBack() or start() returns it to the driver.
    void giveBack(int index) noexcept;
    void takeBack() noexcept;
    /// Returns a file descriptor for poll(). It is readable while takeBack() has buffers to return.
    /// Must not be used after close().
    [[nodiscard]] int givenBack() const { return wake_.get(); }

    [[nodiscard]] int buffers() const { return static_cast<int>(buffers_.size()); }
    /// Returns the first byte of each V4L2 plane of a buffer. The planes may be read while the
    /// caller holds the buffer.
    [[nodiscard]] std::array<const std::uint8_t*, 3> memory(int index) const;
    [[nodiscard]] std::size_t memoryBytes(int index, int piece) const;

    [[nodiscard]] const SharedMemory* shared(int index) const;

    [[nodiscard]] const V4l2Device& device() const { return *device_; }

private:
    enum class Holder { Nobody, Driver, Picture };
    struct Buffer {
        Holder holder = Holder::Nobody;
        std::array<V4l2Device::Mapping, 3> pieces;
        std::array<OwnedFd, 3> exported;
        SharedMemory shared;
    };
    struct Argument;

    void allocate(int buffers);
    void mapBuffer(int index);
    void exportBuffer(int index, const V4l2Layout& layout);
    [[nodiscard]] int queue(int index) noexcept;
    [[nodiscard]] std::vector<int> takeReturned() noexcept;

    std::optional<V4l2Device> device_;
    std::uint32_t type_;
    int pieces_;
    mutable std::mutex mutex_;
    bool running_ = false;
    std::vector<Buffer> buffers_;

    std::mutex returnedMutex_;  ///< guards returned_ and wake_; not locked during driver calls
    std::vector<int> returned_;
    OwnedFd wake_;
};

}  // namespace mfar
