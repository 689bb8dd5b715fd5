#pragma once

#include "base/image_view.h"
#include "hal/device/v4l2_device.h"

#include <linux/videodev2.h>

#include <cerrno>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace mfar::test {

struct FakeFormat {
    std::uint32_t fourcc;
    std::vector<Size> sizes;  ///< if empty, the driver does not list sizes
    double fastest = 30;      ///< highest rate [Hz]
};

struct FakeControl {
    std::uint32_t id;
    std::string name;
    std::uint32_t type;
    std::int64_t minimum, maximum, step, value;
    std::vector<std::string> menu{};
    std::uint32_t flags = 0;
    int refusals = 0;  ///< number of attempts to set the control that fail before one succeeds
    int error = EBUSY;
    bool isUnreadable = false;
};

struct FakePicture {
    std::uint32_t flags = 0;
    std::size_t missingBytes = 0;
    std::int64_t ageMs = 1;
    int skipped = 0;
    std::uint8_t level = 100;
    std::span<const std::uint8_t> jpeg{};
};

/// Writes `text` into `field`, which has `bytes` bytes. A longer text is cut. A text that fills the
/// field does not end with a zero.
void putText(void* field, std::size_t bytes, const std::string& text);

/// A simulated capture device that follows the kernel's documentation. It has one node that
/// captures and one that does not. Its descriptors are pipes, so that poll() and close() are real.
/// Its buffers are in a memory file.
class FakeV4l2 final : public V4l2Api {
public:
    FakeV4l2();
    FakeV4l2(const FakeV4l2&) = delete;
    FakeV4l2& operator=(const FakeV4l2&) = delete;
    ~FakeV4l2() override;

    [[nodiscard]] std::vector<std::string> nodes() override;
    [[nodiscard]] int open(const char* path) override;
    int ioctl(int fd, unsigned long request, void* argument) override;
    [[nodiscard]] void* map(int fd, std::size_t length, std::int64_t offset) override;

    /// Fills a buffer and delivers it. Returns false if the stream is off or no buffer is queued.
    bool deliver(const FakePicture& picture = {});
    void unplug();
    /// From now on, poll() reports POLLHUP. Calls to the driver still succeed.
    void hangUp();
    /// After hang(true), VIDIOC_QBUF, VIDIOC_DQBUF and VIDIOC_STREAMOFF do not return until
    /// hang(false).
    void hang(bool wanted);
    [[nodiscard]] bool hangs();
    [[nodiscard]] int queued();
    [[nodiscard]] bool released();
    [[nodiscard]] std::int64_t control(const std::string& name);

    // Properties of the device; to be set before the device is opened.
    std::string card = "Fake Camera", secondPath;  ///< secondPath: path of another capture node
    bool multiPlanar = false;
    bool busy = false;
    bool hasInput = true;  ///< false: the node gives converted pictures instead of captured ones
    bool rounds = false;   ///< S_FMT answers with another size than requested
    std::uint32_t clock = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    std::size_t padding = 0;  ///< padding of rows [bytes]
    /// Each plane begins this number of bytes after the start of its memory. Needs multiPlanar.
    std::uint32_t dataOffset = 0;
    std::uint32_t mostBuffers = 16;
    /// If true, requests for more than mostBuffers buffers fail with ENOMEM. Otherwise mostBuffers
    /// buffers are granted.
    bool refusesMore = false;
    int sizeFault = 0;  ///< S_FMT adds this to the picture size that it reports [bytes]
    std::uint32_t colorspace = V4L2_COLORSPACE_SRGB, quantization = V4L2_QUANTIZATION_DEFAULT;
    std::vector<FakeFormat> formats{{V4L2_PIX_FMT_YUYV, {{32, 24}, {64, 48}}}};
    std::vector<FakeControl> controls{};

private:
    struct Buffer {
        bool queued = false, done = false;
        v4l2_buffer said{};
        std::vector<v4l2_plane> planes;
    };
    [[nodiscard]] int answer(unsigned long request, void* argument);
    [[nodiscard]] int list(unsigned long request, void* argument);
    [[nodiscard]] int stream(unsigned long request, void* argument);
    [[nodiscard]] int knobs(unsigned long request, void* argument);
    [[nodiscard]] int value(unsigned long request, v4l2_ext_control& one);
    int setFormat(v4l2_format& format);
    int requestBuffers(v4l2_requestbuffers& request);
    int say(v4l2_buffer& to, int index);
    void drain(std::size_t pictures) const;
    int dequeue(v4l2_buffer& to);
    [[nodiscard]] std::vector<std::size_t> planeBytes() const;
    [[nodiscard]] const FakeFormat* find(std::uint32_t fourcc) const;

    std::mutex mutex_;
    std::mutex hangMutex_;
    std::condition_variable mayGoOn_;
    bool hanging_ = false;
    int inside_ = 0;
    int memory_ = -1;
    std::uint8_t* bytes_ = nullptr;
    int pictureEnd_ = -1, readEnd_ = -1;
    std::set<int> plain_;
    bool gone_ = false, running_ = false, released_ = false;
    std::uint32_t fourcc_ = 0;
    Size size_;
    std::uint32_t sequence_ = 0;
    v4l2_fract interval_{1, 30};
    std::vector<Buffer> buffers_;
    std::vector<int> done_;
};

}  // namespace mfar::test
