#include "base/whole_file.h"

#include "base/owned_fd.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

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

/// Asks the file system to make a new file name in this folder safe from a power cut. Errors are
/// ignored, because after a power cut the name leads to the old or to the new content, both whole.
void syncFolder(const std::filesystem::path& folder) {
    const OwnedFd fd(
        open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (fd) fsync(fd.get());
}

/// Name of the temporary file. It contains the thread id, because two threads may write the same
/// file at the same time, and each needs its own temporary file.
std::string partOf(const std::filesystem::path& file) {
    return fmt::format("{}.{}.part", file.string(), gettid());
}

/// Writes the temporary file. Returns an error number. If `syncs` is true, the bytes are on the
/// disk afterwards.
int writePart(const std::filesystem::path& file, std::span<const std::uint8_t> bytes, bool syncs) {
    const int fd = open(partOf(file).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd < 0) return errno;
    int error = writeAll(fd, bytes);
    // The bytes must reach the disk before the new name: otherwise a power cut could leave an empty
    // file.
    if (error == 0 && syncs && fsync(fd) != 0) error = errno;
    if (close(fd) != 0 && error == 0) error = errno;
    return error;
}

/// Returns true if `file` exists and is neither a regular file nor a folder, but e.g. a pipe.
bool isDevice(const std::filesystem::path& file) {
    struct stat there{};
    return stat(file.c_str(), &there) == 0 && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode);
}

int writeInto(const std::filesystem::path& device, std::span<const std::uint8_t> bytes) {
    const int fd = open(device.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (fd < 0) return errno;
    const int error = writeAll(fd, bytes);
    return close(fd) != 0 && error == 0 ? errno : error;
}

/// Returns the file that is replaced when `file` is written: the file itself or, if it is a
/// symbolic link to an existing file, that file.
std::filesystem::path replacedBy(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::path target = std::filesystem::canonical(file, error);
    return error ? file : target;
}

std::span<const std::uint8_t> bytesOf(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

int renamePart(const std::filesystem::path& file) {
    return std::rename(partOf(file).c_str(), file.c_str()) == 0 ? 0 : errno;
}

}  // namespace

void writeWholeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                    Durability durability) {
    if (isDevice(file)) return check(file, writeInto(file, bytes));
    const std::filesystem::path target = replacedBy(file);
    int error = writePart(target, bytes, durability == Durability::OnReturn);
    if (error == 0) error = renamePart(target);
    if (error != 0) unlink(partOf(target).c_str());
    check(file, error);
    if (durability == Durability::OnReturn) syncFolder(target.parent_path());
}

void writeWholeFile(const std::filesystem::path& file, std::string_view text,
                    Durability durability) {
    writeWholeFile(file, bytesOf(text), durability);
}

void writeWholeFiles(std::span<const NewFile> files) {
    std::vector<NewFile> targets(files.begin(), files.end());
    for (NewFile& one : targets)
        if (!isDevice(one.file)) one.file = replacedBy(one.file);
    const auto run = [&](const auto& step) {
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const int error = step(targets[i]);
            if (error == 0) continue;
            for (const NewFile& each : targets)
                unlink(partOf(each.file).c_str());
            check(files[i].file, error);
        }
    };
    run([](const NewFile& one) { return writePart(one.file, bytesOf(one.text), true); });
    run([](const NewFile& one) { return renamePart(one.file); });
    for (const NewFile& one : targets)
        syncFolder(one.file.parent_path());
}

void syncFileSystem(const std::filesystem::path& folder) {
    const OwnedFd fd(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    check(folder, fd && syncfs(fd.get()) == 0 ? 0 : errno);
}

void appendToFile(const std::filesystem::path& file, std::string_view text) {
    const int fd = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (fd < 0) check(file, errno);
    const off_t before = lseek(fd, 0, SEEK_END);
    int error = writeAll(fd, bytesOf(text));
    // Remove the part that was written, because half a line would make the whole file unreadable.
    // If ftruncate() fails as well, nothing more can be done.
    if (error != 0) [[maybe_unused]]
        const int ignored = ftruncate(fd, before);
    if (close(fd) != 0 && error == 0) error = errno;
    check(file, error);
}

}  // namespace mfar
