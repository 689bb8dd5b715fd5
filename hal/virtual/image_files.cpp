#include "hal/virtual/image_files.h"

#include "base/image_layout.h"
#include "base/whole_file.h"
#include "hal/image_codec.h"
#include "hal/virtual/bgr_picture.h"

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include <fstream>
#include <string>
#include <string_view>

namespace mfar {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> bytesOf(const fs::path& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) throw ImageFileError(file, "is missing");
    std::ifstream in(file, std::ios::binary);
    std::vector<std::uint8_t> bytes(fs::file_size(file, ignored));
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!in) throw ImageFileError(file, "cannot be read");
    return bytes;
}

void decode(const fs::path& file, const TargetOf& targetOf) {
    const std::vector<std::uint8_t> bytes = bytesOf(file);
    try {
        decodeImage(bytes, [&](Size size) {
            if (size.width < 1 || size.height < 1 || size.width > kMaxImageSide ||
                size.height > kMaxImageSide)
                throw std::runtime_error(fmt::format("{}x{} pixels", size.width, size.height));
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
    decode(file, [&](Size size) -> PixelTarget {
        const std::size_t stride = std::size_t{4} * size.width;
        out = {size, PixelFormat::Rgba8, std::vector<std::uint8_t>(stride * size.height)};
        return {out.pixels.data(), stride};
    });
    return out;
}

void loadImageInto(const fs::path& file, Size expected, std::uint8_t* rgba, std::size_t stride) {
    decode(file, [&](Size size) -> PixelTarget {
        if (size != expected)
            throw ImageFileError(file, fmt::format("is {}x{}, not {}x{}", size.width, size.height,
                                                   expected.width, expected.height));
        return {rgba, stride};
    });
}

void encodePng(const ImageView& image, std::vector<std::uint8_t>& out) {
    requireSound(image, "picture to be written");
    const auto encode = [&](PngPixels format) {
        encodePng(image.data, image.stride, image.size, format, out);
    };
    switch (image.format) {
    case PixelFormat::Gray8: return encode(PngPixels::Grey);
    case PixelFormat::Rgba8: return encode(PngPixels::Rgbx);
    case PixelFormat::Bgra8: return encode(PngPixels::Bgrx);
    case PixelFormat::Yuyv:
    case PixelFormat::Nv12:
    case PixelFormat::Yuv420: break;
    }
    const cv::Mat bgr = bgrPicture(image);
    encodePng(bgr.ptr(), bgr.step, image.size, PngPixels::Bgr, out);
}

void savePng(const fs::path& file, const ImageView& image) {
    try {
        std::vector<std::uint8_t> bytes;
        encodePng(image, bytes);
        writeWholeFile(file, bytes);
    } catch (const std::runtime_error& e) {
        throw ImageFileError(e.what());
    }
}

}  // namespace mfar
