#include "hal/virtual/png_header.h"

#include "base/owned_fd.h"
#include "hal/virtual/image_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <span>
#include <stdexcept>

namespace mfar {
namespace {

// A PNG file begins with its signature, and the length and name of the IHDR chunk (PNG
// specification, 5.2 and 11.2.2).
constexpr std::array<std::uint8_t, 16> kStart{0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A,
                                              0,    0,   0,   13,  'I',  'H',  'D',  'R'};
constexpr std::array<std::uint8_t, 12> kEnd{0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82};

std::uint32_t bigEndian(const std::uint8_t* p) {
    return std::uint32_t{p[0]} << 24 | std::uint32_t{p[1]} << 16 | std::uint32_t{p[2]} << 8 | p[3];
}

std::size_t readAt(int fd, off_t at, std::span<std::uint8_t> to) {
    ssize_t got = -1;
    do
        got = pread(fd, to.data(), to.size(), at);
    while (got < 0 && errno == EINTR);
    if (got < 0) throw std::runtime_error("cannot be read");
    return static_cast<std::size_t>(got);
}

}  // namespace

Size pngSize(const std::filesystem::path& file) {
    // Without O_NONBLOCK, open() would wait for the writer of a named pipe. std::ifstream is not
    // used, because its buffers would fragment the heap while thousands of files are read.
    const OwnedFd fd(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
    struct stat about{};
    if (!fd && errno != ENOENT && errno != ENOTDIR && errno != ENXIO)
        throw std::runtime_error("cannot be read");
    if (!fd || fstat(fd.get(), &about) != 0 || !S_ISREG(about.st_mode))
        throw std::runtime_error("is missing");
    std::array<std::uint8_t, 24> start{};
    const std::size_t got = readAt(fd.get(), 0, start);
    if (!std::equal(kStart.begin(), kStart.begin() + std::min(got, kStart.size()), start.begin()))
        throw std::runtime_error("is not a PNG file");
    if (got < start.size()) throw std::runtime_error("is a truncated PNG file");
    const std::uint32_t width = bigEndian(&start[16]), height = bigEndian(&start[20]);
    if (width == 0 || height == 0 || width > kMaxImageSide || height > kMaxImageSide)
        throw std::runtime_error("is a PNG file with an invalid size");
    std::array<std::uint8_t, 12> end{};
    const off_t last = about.st_size - static_cast<off_t>(end.size());
    if (readAt(fd.get(), last, end) != end.size() || end != kEnd)
        throw std::runtime_error("is a truncated PNG file");
    return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace mfar
