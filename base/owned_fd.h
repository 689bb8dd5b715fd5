#pragma once

#include <system_error>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace mfar {

/// Owns an open file descriptor and closes it at destruction. Negative: no file. Move-only.
class OwnedFd {
public:
    OwnedFd() = default;
    explicit OwnedFd(int fd) : fd_(fd) {}
    OwnedFd(OwnedFd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    OwnedFd& operator=(OwnedFd&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    OwnedFd(const OwnedFd&) = delete;
    OwnedFd& operator=(const OwnedFd&) = delete;
    ~OwnedFd() {
        if (fd_ >= 0) ::close(fd_);
    }

    [[nodiscard]] int get() const { return fd_; }
    explicit operator bool() const { return fd_ >= 0; }

private:
    int fd_ = -1;
};

/// Wraps the file descriptor that a system call returned. If it is negative, throws
/// std::system_error with errno as the cause and `what` in the message.
[[nodiscard]] inline OwnedFd opened(int fd, const char* what) {
    if (fd < 0) throw std::system_error(errno, std::generic_category(), what);
    return OwnedFd(fd);
}

}  // namespace mfar
