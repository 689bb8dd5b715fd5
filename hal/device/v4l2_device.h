#pragma once

#include "base/owned_fd.h"

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// The system calls to a V4L2 driver. Tests replace them with a simulated driver. open(), ioctl()
/// and map() return what the system calls return, and set errno. nodes() returns the paths of the
/// video devices.
class V4l2Api {
public:
    virtual ~V4l2Api() = default;

    [[nodiscard]] virtual std::vector<std::string> nodes() = 0;
    [[nodiscard]] virtual int open(const char* path) = 0;
    virtual int ioctl(int fd, unsigned long request, void* argument) = 0;
    [[nodiscard]] virtual void* map(int fd, std::size_t length, std::int64_t offset) = 0;
};

[[nodiscard]] V4l2Api& kernelV4l2();

/// Thrown if a system call to the device failed. The message names the device, the reason and,
/// unless the device could not be opened, the action.
class V4l2Error : public std::runtime_error {
public:
    V4l2Error(const std::string& message, int errorNumber)
        : std::runtime_error(message), errorNumber_(errorNumber) {}
    [[nodiscard]] int errorNumber() const { return errorNumber_; }

private:
    int errorNumber_;
};

class V4l2Device {
public:
    V4l2Device(V4l2Api& api, const std::string& path);

    /// Calls ioctl() and returns 0 or the error number. Interrupted calls are repeated.
    [[nodiscard]] int tryCall(unsigned long request, void* argument) const;
    /// Calls ioctl(). If it fails, throws DeviceLost if the device is lost, otherwise a V4l2Error
    /// "PATH: WHAT: reason".
    void call(unsigned long request, void* argument, std::string_view what) const;
    /// Throws the exception that call() would throw for this error number.
    [[noreturn]] void fail(std::string_view what, int errorNumber) const;

    struct Unmap {
        std::size_t length = 0;
        void operator()(std::uint8_t* memory) const;
    };
    using Mapping = std::unique_ptr<std::uint8_t, Unmap>;
    [[nodiscard]] Mapping map(std::size_t length, std::int64_t offset) const;

    [[nodiscard]] int fd() const { return fd_.get(); }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::string& card() const { return card_; }
    [[nodiscard]] const std::string& bus() const { return bus_; }
    [[nodiscard]] std::uint32_t capabilities() const { return capabilities_; }
    [[nodiscard]] bool captures() const;
    [[nodiscard]] bool multiPlanar() const;

private:
    V4l2Api* api_;
    std::string path_, card_, bus_;
    std::uint32_t capabilities_ = 0;
    OwnedFd fd_;
};

/// Returns the text in a driver's character array. The array need not contain a terminating zero.
[[nodiscard]] std::string fieldText(const void* field, std::size_t bytes);

}  // namespace mfar
