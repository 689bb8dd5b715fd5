#pragma once

#include "hal/device/v4l2_formats.h"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace mfar {

/// A buffer that the driver has filled, with what it says of it. Nothing of that is checked but the
/// index.
struct V4l2Filled {
    int index = 0;
    std::uint32_t flags = 0;     ///< V4L2_BUF_FLAG_...
    std::uint32_t sequence = 0;  ///< of the frame, gaps are frames that found no buffer
    std::int64_t seconds = 0, microseconds = 0;
    std::array<std::size_t, 3> offset{}, bytes{};  ///< of what was written in each piece of memory
};

/// The memory-mapped buffers of a capture device: allocated once, on their way between the driver
/// and those who hold a picture. Thread-safe. Holders keep it alive by shared_ptr, so that a
/// picture can be read, and handed back, after the device was closed.
///
/// A driver that hangs holds up who calls start(), stop(), close(), takeBack() or take(), but never
/// who gives a buffer back: that thread may be the one that makes the picture.
class V4l2Stream {
public:
    /// Takes the device, whose format is set. The driver may grant fewer buffers, or more. Throws
    /// std::runtime_error, DeviceLost.
    V4l2Stream(V4l2Device device, const V4l2Layout& layout, int buffers);
    V4l2Stream(const V4l2Stream&) = delete;
    V4l2Stream& operator=(const V4l2Stream&) = delete;
    ~V4l2Stream() { close(); }

    /// Hands every buffer that nobody holds to the driver and lets it run. Throws like the
    /// constructor.
    void start();
    /// Idempotent; a lost device is no error here.
    void stop() noexcept;
    /// stop(), then gives device and buffers up: another program may have the device, while the
    /// memory of lent pictures stays.
    void close() noexcept;

    /// A filled buffer, which is the caller's until giveBack(); nothing when there is none or the
    /// stream does not run. Throws DeviceLost when no further will come.
    [[nodiscard]] std::optional<V4l2Filled> take();
    /// Notes that a buffer is free; makes no call of the driver.
    void giveBack(int index) noexcept;
    /// Hands the buffers that were given back to the driver.
    void takeBack() noexcept;
    /// Readable as long as buffers were given back and not handed to the driver, for poll(). Not
    /// after close().
    [[nodiscard]] int givenBack() const { return wake_.get(); }

    /// How many there are.
    [[nodiscard]] int buffers() const { return static_cast<int>(buffers_.size()); }
    /// Readable while the caller holds the buffer.
    [[nodiscard]] std::array<const std::uint8_t*, 3> memory(int index) const;
    [[nodiscard]] std::size_t memoryBytes(int index, int piece) const;

    /// The same as shared memory; nothing where the driver does not export it.
    [[nodiscard]] const SharedMemory* shared(int index) const;

    /// Not after close().
    [[nodiscard]] const V4l2Device& device() const { return *device_; }

private:
    enum class Holder { Nobody, Driver, Picture };
    struct Buffer {
        Holder holder = Holder::Nobody;
        std::array<V4l2Device::Mapping, 3> pieces;
        std::array<OwnedFd, 3> exported;
        SharedMemory shared;  ///< id 0: none
    };
    /// The argument of a buffer call, with planes where the multi-planar API wants them.
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

    std::mutex returnedMutex_;  ///< of what follows; never held during a call of the driver
    std::vector<int> returned_;
    OwnedFd wake_;  ///< eventfd; none after close()
};

}  // namespace mfar
