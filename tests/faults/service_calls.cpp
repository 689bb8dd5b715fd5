// Replaces calls to the service manager, the log, the disk and sockets, and calls that end the
// process.

#include "tests/faults/board.h"
#include "tests/faults/judge.h"
#include "tests/faults/real_calls.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <errno.h>
#include <string_view>
#include <thread>

#define MFAR_TAKES_OVER extern "C" __attribute__((visibility("default")))

using namespace mfar::faults;

namespace {

/// True only for files of a recording. The disk's faults must not affect other files.
bool isOnDisk(int fd) {
    std::error_code ignored;
    const auto file =
        std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(fd), ignored).string();
    return file.find("/" + std::string(Board::kRecording)) != file.npos;
}

__attribute__((destructor)) void atExit() {
    // The exit status is unknown here. The parent process gets it.
    Judge::get().ended(0, true);
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming)
MFAR_TAKES_OVER int sd_notify(int, const char* text) {
    Judge::get().serviceHears(text);
    return 1;
}

MFAR_TAKES_OVER void _exit(int code) {
    Judge::get().ended(code, true);
    real().exitNow(code);
    __builtin_unreachable();
}

MFAR_TAKES_OVER void _Exit(int code) noexcept {
    _exit(code);
}

MFAR_TAKES_OVER ssize_t write(int fd, const void* bytes, size_t count) {
    if (fd == STDERR_FILENO) Judge::get().logSays({static_cast<const char*>(bytes), count});
    if ((Board::get().diskIsFull() || Board::get().diskHangs()) && isOnDisk(fd)) {
        while (Board::get().diskHangs())
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        if (Board::get().diskIsFull()) {
            errno = ENOSPC;
            return -1;
        }
    }
    return real().syscall(SYS_write, fd, bytes, count);
}

MFAR_TAKES_OVER ssize_t recv(int fd, void* to, size_t size, int flags) {
    constexpr int kPatienceMs = 15'000;
    const bool waits = (flags & MSG_DONTWAIT) == 0 && (fcntl(fd, F_GETFL) & O_NONBLOCK) == 0;
    pollfd readable{fd, POLLIN, 0};
    if (waits && poll(&readable, 1, kPatienceMs) == 0) {
        errno = EAGAIN;
        return -1;
    }
    return real().syscall(SYS_recvfrom, fd, to, size, flags | MSG_DONTWAIT, nullptr, nullptr);
}
