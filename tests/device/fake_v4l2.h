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
    std::vector<Size> sizes;  ///< empty: not listed
    double fastest = 30;      ///< [Hz]
};

struct FakeControl {
    std::uint32_t id;
    std::string name;
    std::uint32_t type;
    std::int64_t minimum, maximum, step, value;
    std::vector<std::string> menu{};
    std::uint32_t flags = 0;
    int refusals = 0;   ///< so many times it is busy
    int error = EBUSY;  ///< with this
};

/// What the driver says of the next picture, where that is not what it is.
struct FakePicture {
    std::uint32_t flags = 0;
    std::size_t missingBytes = 0;
    std::int64_t ageMs = 1;
    int skipped = 0;           ///< pictures lost before it
    std::uint8_t level = 100;  ///< of all its bytes
    std::span<const std::uint8_t> jpeg{};
};

/// Text into a fixed field, which need not end in a zero.
void putText(void* field, std::size_t bytes, const std::string& text);

/// A capture device as the kernel's documentation describes one: one node that captures, one beside
/// it that does not. A pipe stands for its descriptor, so that poll() and close() are the real
/// ones, a memory file for its buffers.
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

    /// Fills a buffer; false when the camera has handed in none.
    bool deliver(const FakePicture& picture = {});
    void unplug();
    /// poll() reports an error, while calls still work.
    void hangUp();
    /// From now on the driver's calls that move buffers do not return, until they may again.
    void hang(bool wanted);
    [[nodiscard]] bool hangs();  ///< a call is inside it
    /// How many buffers wait to be filled.
    [[nodiscard]] int queued();
    [[nodiscard]] bool released();  ///< the buffers were given up
    [[nodiscard]] std::int64_t control(const std::string& name);

    // What it is; to be changed before it is opened.
    std::string card = "Fake Camera", secondPath;  ///< secondPath: a further node that captures
    bool multiPlanar = false;
    bool busy = false;    ///< another program has the buffers
    bool rounds = false;  ///< answers S_FMT with another size
    std::uint32_t clock = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    std::size_t padding = 0;  ///< of rows [bytes]
    std::uint32_t mostBuffers = 16;
    bool refusesMore = false;  ///< has no memory for more than that, instead of granting fewer
    int sizeFault = 0;         ///< added to the size it says a picture has
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
    int pictureEnd_ = -1, readEnd_ = -1;  // of the pipe: deliver() writes, the camera polls
    std::set<int> plain_;                 // descriptors of the node that does not capture
    bool gone_ = false, running_ = false, released_ = false;
    std::uint32_t fourcc_ = 0;
    Size size_;
    std::uint32_t sequence_ = 0;
    v4l2_fract interval_{1, 30};
    std::vector<Buffer> buffers_;
    std::vector<int> done_;
};

}  // namespace mfar::test
