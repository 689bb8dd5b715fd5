#include "base/bounded_file.h"

#include "base/owned_fd.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace mfar {
namespace {

[[noreturn]] void fail(const char* what) {
    throw std::runtime_error(fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

template <class Bytes>
Bytes read(const std::filesystem::path& file, std::size_t most, FileTrust trust) {
    // Without O_NONBLOCK, open() would block on a named pipe that has no writer.
    const int links = trust == FileTrust::OwnFile ? O_NOFOLLOW : 0;
    const OwnedFd fd(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY | links));
    if (fd.get() < 0 && errno == ELOOP && links != 0)
        throw std::runtime_error("is a symbolic link");
    if (fd.get() < 0 && (errno == ENOENT || errno == ENOTDIR))
        throw std::runtime_error("is missing");
    if (fd.get() < 0 && (errno == ENXIO || errno == ENODEV))
        throw std::runtime_error("is not a regular file");
    if (fd.get() < 0) fail("cannot be opened");
    struct stat about{};
    if (fstat(fd.get(), &about) != 0) fail("cannot be read");
    if (!S_ISREG(about.st_mode)) throw std::runtime_error("is not a regular file");
    if (trust == FileTrust::OwnFile && about.st_uid != geteuid())
        throw std::runtime_error("belongs to another user");
    const auto size = static_cast<std::uintmax_t>(about.st_size);
    if (size > most)
        throw std::runtime_error(fmt::format("has {} bytes; the limit is {} bytes", size, most));
    Bytes bytes;
    bytes.resize(static_cast<std::size_t>(size));
    std::size_t at = 0;
    while (at < bytes.size()) {
        const ssize_t got = ::read(fd.get(), bytes.data() + at, bytes.size() - at);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail("cannot be read");
        if (got == 0) throw std::runtime_error("became shorter while it was read");
        at += static_cast<std::size_t>(got);
    }
    // Detects bytes beyond the reported size. Files in /proc report a size of 0 although they have
    // content.
    char more = 0;
    const ssize_t got = ::read(fd.get(), &more, 1);
    if (got < 0) fail("cannot be read");
    if (got > 0) throw std::runtime_error("became longer while it was read");
    return bytes;
}

}  // namespace

std::vector<std::uint8_t> boundedFile(const std::filesystem::path& file, std::size_t most) {
    return read<std::vector<std::uint8_t>>(file, most, FileTrust::Any);
}

std::string boundedText(const std::filesystem::path& file, std::size_t most, FileTrust trust) {
    return read<std::string>(file, most, trust);
}

}  // namespace mfar
