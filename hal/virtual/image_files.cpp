#include "hal/virtual/image_files.h"

#include "base/bounded_file.h"
#include "base/image_layout.h"
#include "base/whole_file.h"
#include "hal/bgr_picture.h"
#include "hal/image_codec.h"

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include <string>
#include <string_view>

namespace mfar {
namespace {

namespace fs = std::filesystem;

std::size_t mostBytes(Size size) {
    constexpr std::size_t kBytesPerPixel = 8, kHeader = 1 << 20;
    return kBytesPerPixel * size.width * size.height + kHeader;
}

std::vector<std::uint8_t> bytesOf(const fs::path& file, std::size_t most) {
    try {
        return boundedFile(file, most);
    } catch (const std::runtime_error& e) {
        throw ImageFileError(file, e.what());
    }
}

void decode(const fs::path& file, std::size_t most, const TargetOf& targetOf) {
    const std::vector<std::uint8_t> bytes = bytesOf(file, most);
    try {
        decodeImage(bytes, [&](Size size) {
            if (size.width < 1 || size.height < 1 || size.width > kMaxImageSide ||
                size.height > kMaxImageSide)
                throw std::runtime_error(
                    fmt::format("size {}x{} is invalid: width and height must be from 1 to {}",
                                size.width, size.height, kMaxImageSide));
            return targetOf(size);
        });
    } catch (const ImageFileError&) {
        throw;
    } catch (const std::runtime_error& e) {
        throw ImageFileError(file, std::string("cannot be decoded: ") + e.what());
    }
}

}  // namespace

StoredImage loadImage(const fs::path& file) {
    StoredImage out;
    decode(file, mostBytes({kMaxImageSide, kMaxImageSide}), [&](Size size) -> PixelTarget {
        const std::size_t stride = std::size_t{4} * size.width;
        out = {size, PixelFormat::Rgba8, std::vector<std::uint8_t>(stride * size.height)};
        return {out.pixels.data(), stride};
    });
    return out;
}

void loadImageInto(const fs::path& file, Size expected, std::uint8_t* rgba, std::size_t stride) {
    decode(file, mostBytes(expected), [&](Size size) -> PixelTarget {
        if (size != expected)
            throw ImageFileError(file, fmt::format("is {}x{}; expected {}x{}", size.width,
                                                   size.height, expected.width, expected.height));
        return {rgba, stride};
    });
}

void encodePng(const ImageView& image, std::vector<std::uint8_t>& out) {
    requireSound(image, "picture to be written");
    const auto encode = [&](PixelBytes format) {
        encodePng(image.data, image.stride, image.size, format, out);
    };
    switch (image.format) {
    case PixelFormat::Gray8: return encode(PixelBytes::Grey);
    case PixelFormat::Rgba8: return encode(PixelBytes::Rgbx);
    case PixelFormat::Bgra8: return encode(PixelBytes::Bgrx);
    case PixelFormat::Yuyv:
    case PixelFormat::Nv12:
    case PixelFormat::Yuv420: break;
    }
    const cv::Mat bgr = bgrPicture(image);
    encodePng(bgr.ptr(), bgr.step, image.size, PixelBytes::Bgr, out);
}

void savePng(const fs::path& file, const ImageView& image) {
    try {
        std::vector<std::uint8_t> bytes;
        encodePng(image, bytes);
        writeWholeFile(file, bytes, Durability::WithSync);
    } catch (const std::runtime_error& e) {
        throw ImageFileError(e.what());
    }
}

}  // namespace mfar
