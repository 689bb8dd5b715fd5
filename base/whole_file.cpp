#include "base/whole_file.h"

#include "base/owned_fd.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <system_error>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

int writeAll(int fd, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = write(fd, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return 0;
}

void check(const std::filesystem::path& file, int error) {
    if (error != 0)
        throw std::runtime_error(
            fmt::format("{}: {}", file.string(), std::generic_category().message(error)));
}

/// Makes the folder's entries safe from a power cut. Errors are ignored: file systems that cannot
/// sync a folder write its entries in order anyway.
void syncFolder(const std::filesystem::path& folder) {
    const OwnedFd fd(
        open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (fd) fsync(fd.get());
}

}  // namespace

void writeWholeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                    Durability durability) {
    // The name contains the thread id, because two threads may write the same file at the same
    // time, and each needs its own temporary file.
    const std::string part = fmt::format("{}.{}.part", file.string(), gettid());
    int error = 0;
    const int fd = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd < 0) {
        error = errno;
    } else {
        error = writeAll(fd, bytes);
        // The bytes must reach the disk before the new name: otherwise a power cut could leave an
        // empty file.
        if (error == 0 && durability == Durability::OnReturn && fsync(fd) != 0) error = errno;
        if (close(fd) != 0 && error == 0) error = errno;
        if (error == 0 && std::rename(part.c_str(), file.c_str()) != 0) error = errno;
        if (error != 0) unlink(part.c_str());
    }
    check(file, error);
    if (durability == Durability::OnReturn) syncFolder(file.parent_path());
}

void syncFileSystem(const std::filesystem::path& folder) {
    const OwnedFd fd(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    check(folder, fd && syncfs(fd.get()) == 0 ? 0 : errno);
}

void appendToFile(const std::filesystem::path& file, std::string_view text) {
    const int fd = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (fd < 0) check(file, errno);
    const off_t before = lseek(fd, 0, SEEK_END);
    int error = writeAll(fd, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    // Remove the part that was written, because half a line would make the whole file unreadable.
    // If ftruncate() fails as well, nothing more can be done.
    if (error != 0) [[maybe_unused]]
        const int ignored = ftruncate(fd, before);
    if (close(fd) != 0 && error == 0) error = errno;
    check(file, error);
}

}  // namespace mfar
