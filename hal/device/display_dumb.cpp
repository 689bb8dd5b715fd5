#include "hal/device/display_buffers.h"
#include "hal/device/display_pixels.h"

#include <fmt/format.h>

#include <sys/mman.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <drm_fourcc.h>
#include <optional>
#include <stdexcept>

namespace mfar {
namespace {

std::runtime_error refused(const char* what) {
    return std::runtime_error(fmt::format("{}: {}", what, std::strerror(errno)));
}

class DumbMemory {
public:
    DumbMemory(int fd, Size size) : fd_(fd) {
        if (drmModeCreateDumbBuffer(fd, static_cast<std::uint32_t>(size.width),
                                    static_cast<std::uint32_t>(size.height), 32, 0, &handle_,
                                    &pitch_, &bytes_) != 0)
            throw refused("a dumb buffer cannot be allocated");
        std::uint64_t offset = 0;
        void* memory = MAP_FAILED;
        if (drmModeMapDumbBuffer(fd, handle_, &offset) == 0)
            memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, fd,
                          static_cast<off_t>(offset));
        const std::uint64_t rows = static_cast<std::uint64_t>(size.height);
        const bool isMapped = memory != MAP_FAILED;
        if (!isMapped || pitch_ < static_cast<std::uint64_t>(size.width) * 4 ||
            bytes_ < rows * pitch_) {
            const std::runtime_error error =
                isMapped
                    ? std::runtime_error("the display driver made a dumb buffer that is too small")
                    : refused("a dumb buffer cannot be mapped");
            if (isMapped) munmap(memory, bytes_);
            drmModeDestroyDumbBuffer(fd, handle_);
            throw error;
        }
        data_ = static_cast<std::uint8_t*>(memory);
    }
    DumbMemory(const DumbMemory&) = delete;
    DumbMemory& operator=(const DumbMemory&) = delete;
    ~DumbMemory() {
        munmap(data_, bytes_);
        drmModeDestroyDumbBuffer(fd_, handle_);
    }

    [[nodiscard]] std::uint8_t* data() const { return data_; }
    [[nodiscard]] std::uint32_t handle() const { return handle_; }
    [[nodiscard]] std::uint32_t pitch() const { return pitch_; }

private:
    int fd_;
    std::uint32_t handle_ = 0, pitch_ = 0;
    std::uint64_t bytes_ = 0;
    std::uint8_t* data_ = nullptr;
};

constexpr PixelLayout kXrgb8888{32, {16, 8}, {8, 8}, {0, 8}, {24, 0}};

class DumbBuffers final : public ScanoutBuffers {
public:
    DumbBuffers(int fd, Size size, ScreenScaler& scaler)
        : reader_(size, scaler), buffers_{{{fd, size}, {fd, size}}} {}

    void begin(const Picture& picture) override { reader_.begin(picture); }
    Ready complete() override {
        Buffer& to = buffers_[next_];
        next_ = 1 - next_;
        reader_.finish([&](const ImageView& picture) {
            packPixels(picture, kXrgb8888, to.memory.data(), to.memory.pitch());
        });
        return {to.framebuffer.id(), OwnedFd()};
    }
    void releaseGl() override { reader_.releaseGl(); }
    [[nodiscard]] ScreenPicture last() const override { return reader_.last(); }

private:
    struct Buffer {
        Buffer(int fd, Size size)
            : memory(fd, size), framebuffer(fd, size, memory.handle(), memory.pitch()) {}
        DumbMemory memory;
        DrmFramebuffer framebuffer;
    };
    ScreenReader reader_;
    std::array<Buffer, 2> buffers_;
    std::size_t next_ = 0;
};

}  // namespace

DrmFramebuffer::DrmFramebuffer(int fd, Size size, std::uint32_t handle, std::uint32_t pitch)
    : fd_(fd) {
    const std::array<std::uint32_t, 4> handles{handle}, pitches{pitch}, offsets{};
    if (drmModeAddFB2(fd, static_cast<std::uint32_t>(size.width),
                      static_cast<std::uint32_t>(size.height), DRM_FORMAT_XRGB8888, handles.data(),
                      pitches.data(), offsets.data(), &id_, 0) != 0)
        throw refused("the display driver does not accept the buffer as a framebuffer");
}

DrmFramebuffer::~DrmFramebuffer() {
    drmModeRmFB(fd_, id_);
}

std::unique_ptr<ScanoutBuffers> makeDumbBuffers(const DrmCard& card, Size size,
                                                ScreenScaler& scaler) {
    return std::make_unique<DumbBuffers>(card.fd(), size, scaler);
}

const char* name(ScanoutMethod method) {
    switch (method) {
    case ScanoutMethod::GbmFenced: return "GBM with fences";
    case ScanoutMethod::Gbm: return "GBM";
    case ScanoutMethod::Dumb: break;
    }
    return "dumb buffers";
}

std::unique_ptr<ScanoutBuffers> makeScanoutBuffers(const DrmCard& card, Size size,
                                                   ScanoutMethod method, ScreenScaler& scaler) {
    if (method == ScanoutMethod::Dumb) return makeDumbBuffers(card, size, scaler);
    return makeGbmBuffers(card, size, method == ScanoutMethod::GbmFenced, scaler);
}

}  // namespace mfar
