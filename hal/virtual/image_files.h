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

/// Thrown if an image file cannot be read or written. The message is "file: fault".
class ImageFileError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    ImageFileError(const std::filesystem::path& file, std::string_view what)
        : std::runtime_error(file.string().append(": ").append(what)) {}
};

inline constexpr int kMaxImageSide = 16384;  ///< [px]; larger pictures are refused

/// A picture that owns its pixels. Rows have no padding; row 0 is the top row.
struct StoredImage {
    Size size;
    PixelFormat format = PixelFormat::Rgba8;
    std::vector<std::uint8_t> pixels;

    [[nodiscard]] ImageView view() const {
        const auto width = static_cast<std::size_t>(size.width);
        return {pixels.data(), size, width * bytesPerPixel(format), format};
    }
};

/// Reads a PNG or JPEG file as RGBA8 with alpha 255. A camera's orientation tag is ignored. Throws
/// ImageFileError.
[[nodiscard]] StoredImage loadImage(const std::filesystem::path& file);
/// Reads a file into the caller's buffer. Throws ImageFileError if the file cannot be read or the
/// picture does not have the size `expected`.
void loadImageInto(const std::filesystem::path& file, Size expected, std::uint8_t* rgba,
                   std::size_t stride);

/// Encodes a picture of any format as PNG, optimised for speed and not for size. Replaces the
/// content of `out`. Throws std::invalid_argument if the view is invalid (requireSound()).
void encodePng(const ImageView& image, std::vector<std::uint8_t>& out);
/// Writes the file completely or not at all (Durability::WithSync). Throws ImageFileError and the
/// exceptions of encodePng().
void savePng(const std::filesystem::path& file, const ImageView& image);

/// A picture with one number per pixel. NaN: the number is unknown. Rows have no padding; row 0 is
/// the top row.
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

/// Reads a portable float map with one channel ("Pf") of either byte order. Infinities become NaN,
/// because some programs write infinity for unknown values. Throws ImageFileError.
[[nodiscard]] FloatImage loadPfm(const std::filesystem::path& file);
/// Writes a portable float map with little-endian values. Infinities become NaN. Throws
/// ImageFileError.
void savePfm(const std::filesystem::path& file, const FloatImage& image);

/// A picture with one vector (x, y) [px] per pixel. NaN: the vector is unknown. Rows have no
/// padding; row 0 is the top row.
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

/// Reads a Middlebury .flo file. A vector is unknown if one component is NaN or has an absolute
/// value above 1e9; it becomes (NaN, NaN). Throws ImageFileError.
[[nodiscard]] FlowImage loadFlo(const std::filesystem::path& file);
void saveFlo(const std::filesystem::path& file, const FlowImage& image);

}  // namespace mfar
