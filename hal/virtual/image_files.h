#pragma once

#include "base/image_view.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// An image file cannot be read or written. The message is "file: fault".
class ImageFileError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    ImageFileError(const std::filesystem::path& file, std::string_view what)
        : std::runtime_error(file.string().append(": ").append(what)) {}
};

inline constexpr int kMaxImageSide = 16384;  ///< [px]; larger pictures are refused

/// A picture in memory, rows without padding, row 0 on top.
struct StoredImage {
    Size size;
    PixelFormat format = PixelFormat::Rgba8;
    std::vector<std::uint8_t> pixels;

    [[nodiscard]] ImageView view() const {
        const auto width = static_cast<std::size_t>(size.width);
        return {pixels.data(), size, width * bytesPerPixel(format), format};
    }
};

/// Reads a PNG or JPEG file (colour or grey, 8 or 16 bits) as RGBA8, alpha 255, pixels in storage
/// order (a camera's orientation tag is ignored). Throws ImageFileError.
[[nodiscard]] StoredImage loadImage(const std::filesystem::path& file);
/// As loadImage(), into the caller's buffer; throws for a picture of another size.
void loadImageInto(const std::filesystem::path& file, Size expected, std::uint8_t* rgba,
                   std::size_t stride);

/// Encodes a picture of any format as PNG (RGB without alpha, or grey); optimised for speed, not
/// size. `out` is reused. Throws std::invalid_argument for an invalid view (requireSound()).
void encodePng(const ImageView& image, std::vector<std::uint8_t>& out);
/// Writes a PNG file completely or not at all (Durability::WithSync). Throws ImageFileError, and
/// like encodePng().
void savePng(const std::filesystem::path& file, const ImageView& image);

/// One number per pixel, row 0 on top, rows without padding. NaN = unknown.
struct FloatImage {
    Size size;
    std::vector<float> values;

    [[nodiscard]] float& at(int x, int y) { return values[index(x, y)]; }
    [[nodiscard]] float at(int x, int y) const { return values[index(x, y)]; }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * size.width + x;
    }
};

/// Portable float map, one channel ("Pf"), either byte order. Infinities, which some sources use
/// for unknown, are read as NaN. Throws ImageFileError.
[[nodiscard]] FloatImage loadPfm(const std::filesystem::path& file);
/// Written as little endian; non-finite values become NaN. Throws ImageFileError.
void savePfm(const std::filesystem::path& file, const FloatImage& image);

/// One vector (x, y) [px] per pixel, row 0 on top, rows without padding. NaN = unknown.
struct FlowImage {
    Size size;
    std::vector<std::array<float, 2>> vectors;

    [[nodiscard]] std::array<float, 2>& at(int x, int y) { return vectors[index(x, y)]; }
    [[nodiscard]] const std::array<float, 2>& at(int x, int y) const {
        return vectors[index(x, y)];
    }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * size.width + x;
    }
};

/// Middlebury .flo. A vector with a component that is not finite or above 1e9 is unknown and read
/// as (NaN, NaN). Throws ImageFileError.
[[nodiscard]] FlowImage loadFlo(const std::filesystem::path& file);
/// Unknown vectors are written as (1e10, 1e10). Throws ImageFileError.
void saveFlo(const std::filesystem::path& file, const FlowImage& image);

}  // namespace mfar
