#pragma once

#include <unistd.h>

#include <utility>

namespace mfar {

/// An open file descriptor. Move-only.
class DisplayFd {
public:
    DisplayFd() = default;
    explicit DisplayFd(int fd) : fd_(fd) {}
    DisplayFd(DisplayFd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    DisplayFd& operator=(DisplayFd&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    DisplayFd(const DisplayFd&) = delete;
    DisplayFd& operator=(const DisplayFd&) = delete;
    ~DisplayFd() {
        if (fd_ >= 0) ::close(fd_);
    }

    [[nodiscard]] int get() const { return fd_; }
    explicit operator bool() const { return fd_ >= 0; }

private:
    int fd_ = -1;
};

/// Deleter of a C handle: std::unique_ptr<drmModeRes, FreedBy<drmModeFreeResources>>.
template <auto Free>
struct FreedBy {
    template <class T>
    void operator()(T* handle) const {
        Free(handle);
    }
};

}  // namespace mfar
