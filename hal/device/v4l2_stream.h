#pragma once

#include "hal/device/v4l2_formats.h"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace mfar {

/// A buffer that the driver has filled, with the driver's description. Only the index is validated.
struct V4l2Filled {
    int index = 0;
    std::uint32_t flags = 0;     ///< V4L2_BUF_FLAG_...
    std::uint32_t sequence = 0;  ///< frame number; gaps are frames that found no buffer
    std::int64_t seconds = 0, microseconds = 0;
    std::array<std::size_t, 3> offset{}, bytes{};  ///< written part of each memory piece
};

/// The memory-mapped buffers of a capture device: allocated once, they circulate between the driver
/// and the holders of pictures. Thread-safe. Holders keep it alive by shared_ptr, so that a picture
/// can be read and returned after the device was closed.
///
/// A driver that hangs blocks the callers of start(), stop(), close(), takeBack() and take(), but
/// never the caller of giveBack(): that thread may be the one that makes the picture.
class V4l2Stream {
public:
    /// Takes ownership of the device, whose format is set. The driver may grant fewer or more
    /// buffers. Throws std::runtime_error, DeviceLost.
    V4l2Stream(V4l2Device device, const V4l2Layout& layout, int buffers);
    V4l2Stream(const V4l2Stream&) = delete;
    V4l2Stream& operator=(const V4l2Stream&) = delete;
    ~V4l2Stream() { close(); }

    /// Queues every buffer that nobody holds and starts the driver. Throws like the constructor.
    void start();
    /// Idempotent; ignores a lost device.
    void stop() noexcept;
    /// Calls stop() and releases device and buffers: another program may use the device, while the
    /// memory of lent pictures stays.
    void close() noexcept;

    /// A filled buffer, which the caller owns until giveBack(); empty when there is none or the
    /// stream does not run. Throws DeviceLost when no more buffers will come.
    [[nodiscard]] std::optional<V4l2Filled> take();
    /// Marks a buffer as free; does not call the driver.
    void giveBack(int index) noexcept;
    /// Queues the returned buffers in the driver.
    void takeBack() noexcept;
    /// A descriptor for poll(), readable while returned buffers wait for takeBack(). Not after
    /// close().
    [[nodiscard]] int givenBack() const { return wake_.get(); }

    /// Number of buffers.
    [[nodiscard]] int buffers() const { return static_cast<int>(buffers_.size()); }
    /// Readable while the caller holds the buffer.
    [[nodiscard]] std::array<const std::uint8_t*, 3> memory(int index) const;
    [[nodiscard]] std::size_t memoryBytes(int index, int piece) const;

    /// The buffer as shared memory; null if the driver does not export it.
    [[nodiscard]] const SharedMemory* shared(int index) const;

    /// Must not be called after close().
    [[nodiscard]] const V4l2Device& device() const { return *device_; }

private:
    enum class Holder { Nobody, Driver, Picture };
    struct Buffer {
        Holder holder = Holder::Nobody;
        std::array<V4l2Device::Mapping, 3> pieces;
        std::array<OwnedFd, 3> exported;
        SharedMemory shared;  ///< id 0: not shared
    };
    /// The argument of a buffer call, with planes for the multi-planar API.
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

    std::mutex returnedMutex_;  ///< guards the following; never held during a driver call
    std::vector<int> returned_;
    OwnedFd wake_;  ///< eventfd; closed by close()
};

}  // namespace mfar
