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

/// An image file cannot be read or written. The message is "file: what is wrong".
class ImageFileError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    ImageFileError(const std::filesystem::path& file, std::string_view what)
        : std::runtime_error(file.string().append(": ").append(what)) {}
};

inline constexpr int kMaxImageSide = 16384;  ///< [px]; a file that says more is refused

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

/// Reads a PNG or JPEG file (colour or grey, 8 or 16 bits) as RGBA8, alpha 255, pixels in the
/// order they are stored in (a camera's orientation tag is not obeyed). Throws ImageFileError.
[[nodiscard]] StoredImage loadImage(const std::filesystem::path& file);
/// The same into a buffer of the caller; a picture of another size is an error.
void loadImageInto(const std::filesystem::path& file, Size expected, std::uint8_t* rgba,
                   std::size_t stride);

/// Encodes a picture of any format as PNG, quickly rather than small: RGB without alpha, or grey.
/// `out` is reused. Throws std::invalid_argument for a view that is not sound (requireSound()).
void encodePng(const ImageView& image, std::vector<std::uint8_t>& out);
/// Writes a PNG file, complete or not at all (Durability::WithSync). Throws ImageFileError, and as
/// encodePng() does.
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
/// Written little endian; what is not finite is written as NaN. Throws ImageFileError.
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

/// Middlebury .flo. A vector with a component that is not finite or beyond 1e9 in size is unknown
/// and is read as (NaN, NaN). Throws ImageFileError.
[[nodiscard]] FlowImage loadFlo(const std::filesystem::path& file);
/// Unknown vectors are written as (1e10, 1e10). Throws ImageFileError.
void saveFlo(const std::filesystem::path& file, const FlowImage& image);

}  // namespace mfar
