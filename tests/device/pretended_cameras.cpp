// Two cameras that do not exist, for the whole program: preloaded (LD_PRELOAD), it answers the
// system calls on /dev/pretended-video and /dev/pretended-still as a V4L2 driver does, 640x480 at
// 30 Hz each. While a file "hang-video" or "hang-still" is in the folder $MFAR_PRETENDED, the
// driver of that camera does not return from its dequeue.

#include "tests/device/fake_v4l2.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdarg>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace mfar::test {
namespace {

constexpr std::string_view kPrefix = "/dev/pretended-";
constexpr std::chrono::milliseconds kPeriod{33}, kHangPoll{20};

class PretendedCamera {
public:
    explicit PretendedCamera(const std::string& name) {
        const char* folder = std::getenv("MFAR_PRETENDED");
        hang_ = std::string(folder != nullptr ? folder : ".") + "/hang-" + name;
        driver_.card = "pretended " + name;
        driver_.formats = {{V4L2_PIX_FMT_YUYV, {{640, 480}}}};
        sensor_ = std::jthread([this](const std::stop_token& stop) {
            for (; !stop.stop_requested(); std::this_thread::sleep_for(kPeriod))
                driver_.deliver();
        });
    }
    [[nodiscard]] int open() { return driver_.open("/dev/video0"); }
    int ioctl(int fd, unsigned long request, void* argument) {
        if (request == VIDIOC_DQBUF)
            while (access(hang_.c_str(), F_OK) == 0)
                std::this_thread::sleep_for(kHangPoll);
        return driver_.ioctl(fd, request, argument);
    }
    [[nodiscard]] void* map(int fd, std::size_t length, std::int64_t offset) {
        return driver_.map(fd, length, offset);
    }

private:
    std::string hang_;
    FakeV4l2 driver_;
    std::jthread sensor_;
};

/// The cameras and their descriptors. Never destroyed, as threads may still hang in it at the exit.
class Cameras {
public:
    static Cameras& get() {
        static auto* all = new Cameras;
        return *all;
    }
    int open(const std::string& name) {
        if (name != "video" && name != "still") {
            errno = ENOENT;
            return -1;
        }
        const std::lock_guard lock(mutex_);
        auto& camera = byName_[name];
        if (!camera) camera = std::make_unique<PretendedCamera>(name);
        const int fd = camera->open();
        if (fd >= 0) byFd_[fd] = camera.get();
        return fd;
    }
    PretendedCamera* find(int fd) {
        const std::lock_guard lock(mutex_);
        const auto found = byFd_.find(fd);
        return found == byFd_.end() ? nullptr : found->second;
    }
    void close(int fd) {
        const std::lock_guard lock(mutex_);
        byFd_.erase(fd);
    }

private:
    std::recursive_mutex mutex_;  // the driver maps and closes as well
    std::map<std::string, std::unique_ptr<PretendedCamera>> byName_;
    std::map<int, PretendedCamera*> byFd_;
};

// Whoever has no such camera open must not make a lock of a process that begins or ends.
std::atomic<bool> anyOpen{false};

PretendedCamera* cameraOf(int fd) {
    return anyOpen ? Cameras::get().find(fd) : nullptr;
}

}  // namespace
}  // namespace mfar::test

using mfar::test::anyOpen;
using mfar::test::cameraOf;
using mfar::test::Cameras;
using mfar::test::kPrefix;

extern "C" {

__attribute__((visibility("default"))) int open(const char* path, int flags, ...) {
    if (std::string_view(path).starts_with(kPrefix)) {
        anyOpen = true;
        return Cameras::get().open(path + kPrefix.size());
    }
    va_list arguments;
    va_start(arguments, flags);
    const int mode = (flags & O_CREAT) != 0 ? va_arg(arguments, int) : 0;
    va_end(arguments);
    return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

__attribute__((visibility("default"))) int ioctl(int fd, unsigned long request, ...) noexcept {
    va_list arguments;
    va_start(arguments, request);
    void* argument = va_arg(arguments, void*);
    va_end(arguments);
    if (auto* camera = cameraOf(fd)) return camera->ioctl(fd, request, argument);
    return static_cast<int>(syscall(SYS_ioctl, fd, request, argument));
}

__attribute__((visibility("default"))) void* mmap(void* at, std::size_t length, int protection,
                                                  int flags, int fd, off_t offset) noexcept {
    if (auto* camera = fd >= 0 ? cameraOf(fd) : nullptr) return camera->map(fd, length, offset);
    return reinterpret_cast<void*>(syscall(SYS_mmap, at, length, protection, flags, fd, offset));
}

__attribute__((visibility("default"))) int close(int fd) {
    if (anyOpen) Cameras::get().close(fd);
    return static_cast<int>(syscall(SYS_close, fd));
}
}
