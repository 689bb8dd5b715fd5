// A library that is preloaded into a program (LD_PRELOAD). It simulates V4L2 cameras and a trigger
// line behind the program's calls of open(), ioctl() and mmap(). The environment variable
// MFAR_PRETENDED_V4L2 names a folder: each file NAME in it makes "/dev/NAME" a camera that offers
// YUYV of any size. The words in the file select faults. The words change when another file is
// renamed onto this file, which is allowed at any time:
//   hang          calls that queue or dequeue buffers or stop the stream do not return
//   hang-open     opening does not return
//   hang-close    closing does not return
//   slow MS       opening takes MS milliseconds
//   gone          unplugged: open descriptors fail, nothing can be opened
//   unplug N      a new N means unplugged and plugged in again: devices opened before are lost
//   refuse N      after opening, the first N attempts to set the control "Gain" are refused
//   eio           taking a picture fails until the camera is opened again
//   silent        no further pictures
//   repeat        always the same picture
//   rate HZ       pictures come at this rate instead of the requested one
//   buffers N     grants at most N buffers to a request
//   error N       every N-th picture has the error flag
//   short N       every N-th picture is truncated
//   backward N    every N-th picture's time is before the previous one's
//   future N      every N-th picture's time is one hour ahead
//   skip N        N picture numbers are skipped when this word first appears
//   restart       picture numbers restart at 0 when this word first appears
//   plain         no fault, but the time is not drawn into the pictures
//   triggered     no fault; one picture for each pulse of the trigger line
// The file "gpiochip0" is a GPIO chip with the line TRIGGER:
//   gone          unplugged
//   busy          another program uses the line
//   eio           setting the line fails
// Pictures are noise on grey; their time is drawn across the upper half, see pretended_picture.h. A
// picture without a free buffer gets no number.

#include "tests/device/pretended_camera.h"
#include "tests/device/pretended_gpio.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace {

using mfar::pretended::Device;
using mfar::pretended::GpioChip;

std::mutex devicesMutex;

std::map<int, std::shared_ptr<Device>>& devices() {
    static auto* all = new std::map<int, std::shared_ptr<Device>>;  // threads outlive main()
    return *all;
}

std::shared_ptr<Device> deviceOf(int fd) {
    const std::lock_guard lock(devicesMutex);
    const auto at = devices().find(fd);
    return at == devices().end() ? nullptr : at->second;
}

/// Opens a simulated device. Returns -1 with errno if this fails; returns nothing for other files.
std::optional<int> openDevice(const char* path) {
    const char* folder = std::getenv("MFAR_PRETENDED_V4L2");
    if (folder == nullptr || std::strncmp(path, "/dev/", 5) != 0) return std::nullopt;
    const std::string name = path + 5;
    const std::string file = std::string(folder) + "/" + name;
    if (name.find('/') != std::string::npos || access(file.c_str(), R_OK) != 0) return std::nullopt;
    auto device = std::make_shared<Device>(file, name);
    if (const int error = device->open()) {
        syscall(SYS_close, device->fd());
        errno = error;
        return -1;
    }
    const std::lock_guard lock(devicesMutex);
    devices()[device->fd()] = device;
    return device->fd();
}

void* mapFile(void* at, std::size_t length, int protection, int flags, int fd, off_t offset) {
    if (fd >= 0)
        if (const auto device = deviceOf(fd)) fd = device->memory();
    const long out = syscall(SYS_mmap, at, length, protection, flags, fd, offset);
    return reinterpret_cast<void*>(out);
}

/// Returns the folder of the simulated devices if it contains a GPIO chip, otherwise "".
std::string folderWithChip() {
    const char* folder = std::getenv("MFAR_PRETENDED_V4L2");
    if (folder == nullptr) return "";
    return access((std::string(folder) + "/gpiochip0").c_str(), R_OK) == 0 ? folder : "";
}

bool isOfGpio(std::string_view path) {
    return (path == GpioChip::kPath || path == GpioChip::kNumbers) && GpioChip::get().isThere();
}

int openFile(const char* path, int flags, mode_t mode) {
    if (isOfGpio(path)) return GpioChip::get().open(path);
    if (const std::optional<int> pretended = openDevice(path)) return *pretended;
    return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const auto mode = static_cast<mode_t>(va_arg(rest, int));
    va_end(rest);
    return openFile(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const auto mode = static_cast<mode_t>(va_arg(rest, int));
    va_end(rest);
    return openFile(path, flags | O_LARGEFILE, mode);
}

int openat(int folder, const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const auto mode = static_cast<mode_t>(va_arg(rest, int));
    va_end(rest);
    // A program that is linked with this library may change the folder while it runs.
    std::string devices;
    if (std::string_view(path) == "/dev") devices = folderWithChip();
    if (!devices.empty()) path = devices.c_str();
    return static_cast<int>(syscall(SYS_openat, folder, path, flags, mode));
}

int lstat(const char* path, struct stat* out) noexcept {
    if (isOfGpio(path)) return GpioChip::describe(out);
    return fstatat(AT_FDCWD, path, out, AT_SYMLINK_NOFOLLOW);
}

int stat(const char* path, struct stat* out) noexcept {
    if (isOfGpio(path)) return GpioChip::describe(out);
    return fstatat(AT_FDCWD, path, out, 0);
}

int access(const char* path, int mode) noexcept {
    if (isOfGpio(path)) return 0;
    return faccessat(AT_FDCWD, path, mode, 0);
}

int ioctl(int fd, unsigned long request, ...) noexcept {
    va_list rest;
    va_start(rest, request);
    void* argument = va_arg(rest, void*);
    va_end(rest);
    const auto device = deviceOf(fd);
    if (device || GpioChip::get().owns(fd)) {
        const int error =
            device ? device->call(request, argument) : GpioChip::get().call(fd, request, argument);
        if (error == 0) return 0;
        errno = error;
        return -1;
    }
    return static_cast<int>(syscall(SYS_ioctl, fd, request, argument));
}

void* mmap(void* at, std::size_t length, int protection, int flags, int fd, off_t offset) noexcept {
    return mapFile(at, length, protection, flags, fd, offset);
}

void* mmap64(void* at, std::size_t length, int protection, int flags, int fd,
             off64_t offset) noexcept {
    return mapFile(at, length, protection, flags, fd, offset);
}

// Forgets the device, because the descriptor's number may be reused for another file.
int close(int fd) {
    std::shared_ptr<Device> closed;
    {
        const std::lock_guard lock(devicesMutex);
        const auto at = devices().find(fd);
        if (at != devices().end()) {
            closed = at->second;
            devices().erase(at);
        }
    }
    GpioChip::get().forget(fd);
    if (closed) closed->waitWhile("hang-close");
    closed.reset();
    return static_cast<int>(syscall(SYS_close, fd));
}
}  // extern "C"
