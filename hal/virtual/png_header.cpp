#include "hal/virtual/png_header.h"

#include "hal/virtual/image_files.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace mfar {
namespace {

// Signature, then the length and name of the IHDR chunk (PNG specification, 5.2 and 11.2.2).
constexpr std::array<std::uint8_t, 16> kStart{0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A,
                                              0,    0,   0,   13,  'I',  'H',  'D',  'R'};
// The IEND chunk is always these twelve bytes.
constexpr std::array<std::uint8_t, 12> kEnd{0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82};

std::uint32_t bigEndian(const std::uint8_t* p) {
    return std::uint32_t{p[0]} << 24 | std::uint32_t{p[1]} << 16 | std::uint32_t{p[2]} << 8 | p[3];
}

}  // namespace

Size pngSize(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file)) throw std::runtime_error("is missing");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("cannot be read");
    std::array<std::uint8_t, 24> start{};
    in.read(reinterpret_cast<char*>(start.data()), start.size());
    const auto got = static_cast<std::size_t>(in.gcount());
    if (!std::equal(kStart.begin(), kStart.begin() + std::min(got, kStart.size()), start.begin()))
        throw std::runtime_error("is not a PNG file");
    if (got < start.size()) throw std::runtime_error("is a truncated PNG file");
    const std::uint32_t width = bigEndian(&start[16]), height = bigEndian(&start[20]);
    if (width == 0 || height == 0 || width > kMaxImageSide || height > kMaxImageSide)
        throw std::runtime_error("is a PNG file of impossible size");
    std::array<std::uint8_t, 12> end{};
    in.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    in.read(reinterpret_cast<char*>(end.data()), end.size());
    if (!in || end != kEnd) throw std::runtime_error("is a truncated PNG file");
    return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace mfar
