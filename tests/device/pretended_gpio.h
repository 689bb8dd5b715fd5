#pragma once

#include "tests/device/pretended_counts.h"
#include "tests/device/pretended_words.h"

#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace mfar::pretended {

/// Time at which the trigger line was last activated [us]; 0: never.
inline std::atomic<std::int64_t>& lastPulse() {
    static std::atomic<std::int64_t> us{0};
    return us;
}

/// A GPIO chip whose line 5 is "TRIGGER". It implements version 1 of the kernel's interface, which
/// libgpiod 1 uses. The environment variable MFAR_PRETENDED_V4L2 names a folder. The chip exists if
/// this folder contains a file "gpiochip0". Words in this file select faults, see
/// pretended_v4l2.cpp. The file "line" in the folder contains the level, 0 or 1. As on a real line,
/// the level outlives the program. Thread-safe.
class GpioChip {
public:
    static constexpr std::string_view kPath = "/dev/gpiochip0",
                                      kNumbers = "/sys/bus/gpio/devices/gpiochip0/dev";

    static GpioChip& get() {
        static auto* chip = new GpioChip;  // never freed, because threads outlive main()
        return *chip;
    }

    [[nodiscard]] bool isThere() const {
        return !folder_.empty() && ::faccessat(AT_FDCWD, file("gpiochip0").c_str(), R_OK, 0) == 0;
    }
    [[nodiscard]] std::string file(const char* name) const { return folder_ + "/" + name; }

    static int describe(struct stat* out) {
        *out = {};
        out->st_mode = S_IFCHR | 0660;
        out->st_rdev = makedev(kMajor, 0);
        return 0;
    }

    /// Opens the chip, or the file with its device numbers. Returns a descriptor; -1 with errno on
    /// errors.
    int open(std::string_view path) {
        if (path == kNumbers) return numbers();
        if (words_.now().contains("gone")) {
            errno = ENODEV;
            return -1;
        }
        return take(Kind::Chip);
    }
    [[nodiscard]] bool owns(int fd) const {
        const std::lock_guard lock(mutex_);
        return files_.contains(fd);
    }
    void forget(int fd) {
        const std::lock_guard lock(mutex_);
        files_.erase(fd);
    }

    int call(int fd, unsigned long request, void* argument) {
        const Words wrong = words_.now();
        if (wrong.contains("gone")) return ENODEV;
        switch (request) {
        case GPIO_GET_CHIPINFO_IOCTL: {
            auto& about = *static_cast<gpiochip_info*>(argument);
            about = {};
            std::strncpy(about.name, "gpiochip0", sizeof about.name - 1);
            std::strncpy(about.label, "pretended", sizeof about.label - 1);
            about.lines = kLines;
            return 0;
        }
        case GPIO_GET_LINEINFO_IOCTL: {
            auto& about = *static_cast<gpioline_info*>(argument);
            const std::uint32_t line = about.line_offset;
            if (line >= kLines) return EINVAL;
            about = {};
            about.line_offset = line;
            if (line == kTrigger) std::strncpy(about.name, "TRIGGER", sizeof about.name - 1);
            return 0;
        }
        case GPIO_GET_LINEHANDLE_IOCTL:
            return take(*static_cast<gpiohandle_request*>(argument), wrong);
        case GPIOHANDLE_SET_LINE_VALUES_IOCTL: {
            if (wrong.contains("eio")) return EIO;
            const bool isLow = isActiveLow(fd);
            set((static_cast<gpiohandle_data*>(argument)->values[0] != 0) != isLow, isLow);
            return 0;
        }
        default: return ENOTTY;
        }
    }

private:
    enum class Kind { Chip, Line, LowLine };

    static constexpr std::uint32_t kLines = 8, kTrigger = 5;
    static constexpr unsigned kMajor = 254;

    GpioChip() = default;
    static std::string environment(const char* name) {
        const char* text = std::getenv(name);
        return text != nullptr ? text : "";
    }

    static int numbers() {
        const std::string text = std::to_string(kMajor) + ":0\n";
        const int fd = memfd_create("dev", MFD_CLOEXEC);
        static_cast<void>(!pwrite(fd, text.data(), text.size(), 0));
        return fd;
    }

    int take(Kind kind) {
        const int fd = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
        if (fd < 0) return fd;
        const std::lock_guard lock(mutex_);
        files_[fd] = kind;
        return fd;
    }
    int take(gpiohandle_request& request, const Words& wrong) {
        if (wrong.contains("busy")) return EBUSY;
        if (request.lines != 1 || request.lineoffsets[0] != kTrigger) return EINVAL;
        const bool isLow = (request.flags & GPIOHANDLE_REQUEST_ACTIVE_LOW) != 0;
        request.fd = take(isLow ? Kind::LowLine : Kind::Line);
        if (request.fd < 0) return errno;
        set((request.default_values[0] != 0) != isLow, isLow);
        return 0;
    }

    [[nodiscard]] bool isActiveLow(int fd) const {
        const std::lock_guard lock(mutex_);
        const auto at = files_.find(fd);
        return at != files_.end() && at->second == Kind::LowLine;
    }

    void set(bool high, bool activeLow) {
        const auto file = static_cast<int>(
            syscall(SYS_openat, AT_FDCWD, this->file("line").c_str(), O_WRONLY | O_CREAT, 0666));
        static_cast<void>(!pwrite(file, high ? "1" : "0", 1, 0));
        syscall(SYS_close, file);
        if (high != activeLow) lastPulse() = microsecondsNow();
    }

    const std::string folder_ = environment("MFAR_PRETENDED_V4L2");
    const WordFile words_{file("gpiochip0")};
    mutable std::mutex mutex_;
    std::map<int, Kind> files_;
};

}  // namespace mfar::pretended
