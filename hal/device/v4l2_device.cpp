#include "hal/device/v4l2_device.h"

#include "hal/camera.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace mfar {
namespace {

class Kernel final : public V4l2Api {
public:
    [[nodiscard]] std::vector<std::string> nodes() override {
        std::vector<std::string> out;
        std::error_code error;
        for (const auto& entry : std::filesystem::directory_iterator("/dev", error))
            // A link is a further name of a device, not a further device.
            if (std::error_code ignored;
                !entry.is_symlink(ignored) && entry.path().filename().string().starts_with("video"))
                out.push_back(entry.path().string());
        std::sort(out.begin(), out.end());
        return out;
    }
    [[nodiscard]] int open(const char* path) override {
        return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    }
    int ioctl(int fd, unsigned long request, void* argument) override {
        return ::ioctl(fd, request, argument);
    }
    [[nodiscard]] void* map(int fd, std::size_t length, std::int64_t offset) override {
        return ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, fd, offset);
    }
};

std::string reason(int errorNumber) {
    if (errorNumber == EBUSY) return "busy: another program uses it";
    return std::generic_category().message(errorNumber);
}

}  // namespace

V4l2Api& kernelV4l2() {
    static Kernel kernel;
    return kernel;
}

std::string fieldText(const void* field, std::size_t bytes) {
    const auto* text = static_cast<const char*>(field);
    return {text, strnlen(text, bytes)};
}

V4l2Device::V4l2Device(V4l2Api& api, const std::string& path) : api_(&api), path_(path) {
    fd_ = OwnedFd(api.open(path.c_str()));
    if (fd_.get() < 0) throw V4l2Error(fmt::format("{}: {}", path, reason(errno)), errno);
    v4l2_capability about{};
    if (const int error = tryCall(VIDIOC_QUERYCAP, &about))
        throw V4l2Error(fmt::format("{}: is not a V4L2 device ({})", path, reason(error)), error);
    card_ = fieldText(about.card, sizeof about.card);
    bus_ = fieldText(about.bus_info, sizeof about.bus_info);
    capabilities_ =
        (about.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? about.device_caps : about.capabilities;
}

int V4l2Device::tryCall(unsigned long request, void* argument) const {
    while (api_->ioctl(fd_.get(), request, argument) < 0)
        if (errno != EINTR) return errno;
    return 0;
}

void V4l2Device::call(unsigned long request, void* argument, std::string_view what) const {
    if (const int error = tryCall(request, argument)) fail(what, error);
}

void V4l2Device::fail(std::string_view what, int errorNumber) const {
    const std::string message = fmt::format("{}: {}: {}", path_, what, reason(errorNumber));
    if (errorNumber == ENODEV || errorNumber == ENXIO) throw DeviceLost(message);
    throw V4l2Error(message, errorNumber);
}

void V4l2Device::Unmap::operator()(std::uint8_t* memory) const {
    ::munmap(memory, length);
}

V4l2Device::Mapping V4l2Device::map(std::size_t length, std::int64_t offset) const {
    void* memory = api_->map(fd_.get(), length, offset);
    if (memory == MAP_FAILED) fail("mapping a buffer", errno);
    return {static_cast<std::uint8_t*>(memory), Unmap{length}};
}

bool V4l2Device::captures() const {
    constexpr std::uint32_t kCapture = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_VIDEO_CAPTURE_MPLANE;
    return (capabilities_ & kCapture) != 0 && (capabilities_ & V4L2_CAP_STREAMING) != 0;
}

bool V4l2Device::multiPlanar() const {
    return (capabilities_ & V4L2_CAP_VIDEO_CAPTURE) == 0;
}

}  // namespace mfar
