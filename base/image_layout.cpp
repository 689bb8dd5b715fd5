#include "base/image_layout.h"

#include <atomic>
#include <cstring>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

bool sharesColumns(PixelFormat format) {
    return format == PixelFormat::Yuyv || format == PixelFormat::Nv12 ||
           format == PixelFormat::Yuv420;
}

bool sharesRows(PixelFormat format) {
    return format == PixelFormat::Nv12 || format == PixelFormat::Yuv420;
}

PlaneView planeOf(const ImageView& picture, int plane) {
    if (plane == 0) return {picture.data, picture.stride};
    return picture.chroma[static_cast<std::size_t>(plane) - 1];
}

std::string faultOf(const ImageView& picture) {
    const auto [width, height] = picture.size;
    const auto is = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > kMaxPictureSide || height > kMaxPictureSide)
        return is + " is not a valid picture size";
    const std::string format(nameOf(picture.format));
    if ((sharesColumns(picture.format) && width % 2 != 0) ||
        (sharesRows(picture.format) && height % 2 != 0))
        return is + " has an odd side, which " + format + " does not allow";
    for (int i = 0; i < planeCount(picture.format); ++i) {
        const PlaneView plane = planeOf(picture, i);
        const auto name = "plane " + std::to_string(i) + " of " + format;
        if (plane.data == nullptr) return name + " is missing";
        const std::size_t needed = planeSize(picture.format, picture.size, i).rowBytes;
        if (plane.stride < needed)
            return name + " has rows of " + std::to_string(plane.stride) +
                   " bytes, but a row of the picture needs " + std::to_string(needed);
    }
    return {};
}

}  // namespace

std::uint64_t newSharedMemoryId() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::string_view nameOf(PixelFormat format) {
    switch (format) {
    case PixelFormat::Gray8: return "grey";
    case PixelFormat::Rgba8: return "RGBA";
    case PixelFormat::Bgra8: return "BGRA";
    case PixelFormat::Yuyv: return "YUYV";
    case PixelFormat::Nv12: return "NV12";
    case PixelFormat::Yuv420: break;
    }
    return "YUV420";
}

int planeCount(PixelFormat format) {
    if (format == PixelFormat::Nv12) return 2;
    return format == PixelFormat::Yuv420 ? 3 : 1;
}

PlaneSize planeSize(PixelFormat format, Size size, int plane) {
    const auto width = static_cast<std::size_t>(size.width);
    if (plane == 0) return {width * bytesPerPixel(format), size.height};
    if (plane >= planeCount(format)) return {};
    return {format == PixelFormat::Nv12 ? width : width / 2, size.height / 2};
}

std::size_t packedBytes(PixelFormat format, Size size) {
    std::size_t sum = 0;
    for (int i = 0; i < planeCount(format); ++i) {
        const PlaneSize plane = planeSize(format, size, i);
        sum += plane.rowBytes * plane.rows;
    }
    return sum;
}

ImageView packedView(const std::uint8_t* data, Size size, PixelFormat format) {
    ImageView out{data, size, planeSize(format, size, 0).rowBytes, format};
    for (int i = 1; i < planeCount(format); ++i) {
        const PlaneSize before = planeSize(format, size, i - 1);
        data += before.rowBytes * before.rows;
        out.chroma[static_cast<std::size_t>(i) - 1] = {data, planeSize(format, size, i).rowBytes};
    }
    return out;
}

ImageView packInto(std::uint8_t* data, const ImageView& picture) {
    ImageView out = packedView(data, picture.size, picture.format);
    out.matrix = picture.matrix;
    out.range = picture.range;
    for (int i = 0; i < planeCount(picture.format); ++i) {
        const PlaneSize plane = planeSize(picture.format, picture.size, i);
        const PlaneView from = planeOf(picture, i);
        for (int y = 0; y < plane.rows; ++y, data += plane.rowBytes)
            std::memcpy(data, from.data + y * from.stride, plane.rowBytes);
    }
    return out;
}

void requireSound(const ImageView& picture, std::string_view what) {
    const std::string fault = faultOf(picture);
    if (!fault.empty()) throw std::invalid_argument(std::string(what) + ": " + fault);
}

std::optional<ImageView> lumaPlane(const ImageView& picture) {
    if (picture.format != PixelFormat::Gray8 && planeCount(picture.format) == 1)
        return std::nullopt;
    return ImageView{picture.data, picture.size, picture.stride, PixelFormat::Gray8};
}

YuvToRgb yuvToRgb(YuvMatrix matrix, YuvRange range) {
    const bool hd = matrix == YuvMatrix::Bt709, full = range == YuvRange::Full;
    const double red = hd ? 0.2126 : 0.299, blue = hd ? 0.0722 : 0.114, green = 1 - red - blue;
    const double y = full ? 1 : 255.0 / 219, black = full ? 0 : 16, c = full ? 1 : 255.0 / 224;
    const double v[3] = {2 * (1 - red) * c, -2 * red * (1 - red) / green * c, 0};
    const double u[3] = {0, -2 * blue * (1 - blue) / green * c, 2 * (1 - blue) * c};
    YuvToRgb out{};
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = {static_cast<float>(y), static_cast<float>(u[i]), static_cast<float>(v[i]),
                  static_cast<float>(-y * black - 128 * (u[i] + v[i]))};
    return out;
}

}  // namespace mfar
