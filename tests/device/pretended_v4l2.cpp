// A library to be loaded before a program (LD_PRELOAD): V4L2 cameras that the machine does not
// have, on the program's own calls of open(), ioctl() and mmap(), and a trigger's line. The devices
// are the files of the folder MFAR_PRETENDED_V4L2, each "/dev/NAME" a camera that gives YUYV of any
// size. The file's words say what is wrong with it, and may change at any time, by renaming another
// file onto it:
//   hang          the calls that move buffers do not return
//   hang-open     opening it does not return, and
//   hang-close    neither does closing it
//   slow MS       opening takes so long
//   gone          it is unplugged: what is open fails, nothing can be opened
//   unplug N      the device is lost that was opened at another N
//   refuse N      the first N settings of its control, "gain", since it was opened are refused
//   eio           taking a picture fails, until the camera is opened anew
//   silent        no further picture
//   repeat        the same picture again and again
//   rate HZ       other than was asked for
//   buffers N     grants no more, to the next who asks
//   error N       one of N pictures has the error flag
//   short N       one of N pictures lacks its end
//   backward N    one of N pictures is stamped before the one before
//   future N      one of N pictures is stamped in an hour
//   skip N        with each word's first sight, N numbers are left out
//   restart       with each word's first sight, numbers begin at 0
//   plain         nothing wrong, but pictures without their time
//   triggered     nothing wrong, a picture for each pulse of the line
// The file "gpiochip0" is a GPIO chip with the line TRIGGER:
//   gone          it is unplugged
//   busy          somebody else has the line
//   eio           the line cannot be set
// Pictures are noise over a gray, with their time across the upper half, see pretended_picture.h.
// One that finds no buffer has no number.

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

/// Its descriptor, -1 with errno for one that cannot be opened; nothing for any other file.
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

// Who looks for chips in /dev finds those that are pretended.
int openat(int folder, const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const auto mode = static_cast<mode_t>(va_arg(rest, int));
    va_end(rest);
    if (std::string_view(path) == "/dev" && GpioChip::get().isThere())
        path = GpioChip::get().folder().c_str();
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

// A descriptor that is closed may come back as any other file.
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
