#include "hal/device/v4l2_formats.h"

#include "base/image_layout.h"

#include <fmt/format.h>

#include <stdexcept>

namespace mfar {
namespace {

// Largest stride of a picture [bytes]. A larger one is a fault of the driver.
constexpr std::size_t kMostStride = std::size_t{1} << 20;

struct Answer {
    std::uint32_t fourcc = 0, colorspace = 0, matrix = 0, range = 0;
    Size size;
    int memoryPlanes = 1;
    std::array<std::size_t, 3> strides{}, bytes{};
};

Answer answerOf(const v4l2_pix_format& f) {
    Answer out{f.pixelformat,
               f.colorspace,
               f.ycbcr_enc,
               f.quantization,
               {static_cast<int>(f.width), static_cast<int>(f.height)}};
    out.strides[0] = f.bytesperline;
    out.bytes[0] = f.sizeimage;
    return out;
}

Answer answerOf(const v4l2_pix_format_mplane& f) {
    Answer out{f.pixelformat,
               f.colorspace,
               f.ycbcr_enc,
               f.quantization,
               {static_cast<int>(f.width), static_cast<int>(f.height)},
               f.num_planes};
    for (std::size_t i = 0; i < std::min<std::size_t>(f.num_planes, 3); ++i) {
        out.strides[i] = f.plane_fmt[i].bytesperline;
        out.bytes[i] = f.plane_fmt[i].sizeimage;
    }
    return out;
}

Answer askFormat(const V4l2Device& device, const V4l2PixelFormat& format, Size size) {
    v4l2_format request{};
    request.type = bufferType(device);
    const auto width = static_cast<std::uint32_t>(size.width);
    const auto height = static_cast<std::uint32_t>(size.height);
    const bool mplane = device.multiPlanar();
    if (mplane) {
        request.fmt.pix_mp.width = width;
        request.fmt.pix_mp.height = height;
        request.fmt.pix_mp.pixelformat = format.fourcc;
        request.fmt.pix_mp.field = V4L2_FIELD_NONE;
    } else {
        request.fmt.pix.width = width;
        request.fmt.pix.height = height;
        request.fmt.pix.pixelformat = format.fourcc;
        request.fmt.pix.field = V4L2_FIELD_NONE;
    }
    device.call(VIDIOC_S_FMT, &request, "setting the format");
    return mplane ? answerOf(request.fmt.pix_mp) : answerOf(request.fmt.pix);
}

[[noreturn]] void impossible(const V4l2Device& device, const std::string& what) {
    throw std::runtime_error(
        fmt::format("{}: the driver reports an invalid format: {}", device.path(), what));
}

void setColours(const Answer& answer, V4l2Layout& out) {
    const bool hd = answer.colorspace == V4L2_COLORSPACE_REC709;
    const bool standard = answer.matrix == V4L2_YCBCR_ENC_DEFAULT;
    out.matrix = answer.matrix == V4L2_YCBCR_ENC_709 || (standard && hd) ? YuvMatrix::Bt709
                                                                         : YuvMatrix::Bt601;
    const bool jpeg = out.format.jpeg || answer.colorspace == V4L2_COLORSPACE_JPEG;
    out.range = answer.range == V4L2_QUANTIZATION_FULL_RANGE ||
                        (answer.range == V4L2_QUANTIZATION_DEFAULT && jpeg)
                    ? YuvRange::Full
                    : YuvRange::Limited;
}

void placeInOnePiece(std::size_t stride, V4l2Layout& out) {
    std::size_t offset = 0;
    for (int i = 0; i < planeCount(out.format.picture); ++i) {
        const bool half = i > 0 && out.format.picture == PixelFormat::Yuv420;
        const std::size_t own = half ? stride / 2 : stride;
        out.planes[static_cast<std::size_t>(i)] = {0, offset, own};
        offset += own * planeSize(out.format.picture, out.size, i).rows;
    }
    out.bytes[0] = offset;
}

void placeInOwnPieces(const Answer& answer, V4l2Layout& out) {
    for (int i = 0; i < planeCount(out.format.picture); ++i) {
        const auto p = static_cast<std::size_t>(i);
        out.planes[p] = {i, 0, answer.strides[p]};
        out.bytes[p] = answer.strides[p] * planeSize(out.format.picture, out.size, i).rows;
    }
}

void place(const V4l2Device& device, const Answer& answer, V4l2Layout& out) {
    for (int i = 0; i < out.memoryPlanes; ++i)
        if (answer.strides[static_cast<std::size_t>(i)] > kMostStride)
            impossible(device, fmt::format("a row has {} bytes",
                                           answer.strides[static_cast<std::size_t>(i)]));
    if (out.format.separatePlanes)
        placeInOwnPieces(answer, out);
    else
        placeInOnePiece(answer.strides[0], out);
    for (int i = 0; i < out.memoryPlanes; ++i) {
        const auto p = static_cast<std::size_t>(i);
        if (answer.bytes[p] < out.bytes[p])
            impossible(device, fmt::format("a picture has {} bytes, but its rows need {}",
                                           answer.bytes[p], out.bytes[p]));
    }
    const std::uint8_t somewhere = 0;
    try {
        requireSound(out.view({&somewhere, &somewhere, &somewhere}), device.path());
    } catch (const std::invalid_argument& e) {
        throw std::runtime_error(e.what());
    }
}

}  // namespace

ImageView V4l2Layout::view(const std::array<const std::uint8_t*, 3>& memory) const {
    const auto at = [&](std::size_t plane) {
        const Plane& p = planes[plane];
        return PlaneView{memory[static_cast<std::size_t>(p.memory)] + p.offset, p.stride};
    };
    ImageView out{at(0).data, size, planes[0].stride, format.picture};
    for (std::size_t i = 1; i < static_cast<std::size_t>(planeCount(format.picture)); ++i)
        out.chroma[i - 1] = at(i);
    out.matrix = matrix;
    out.range = range;
    return out;
}

V4l2Layout setFormat(const V4l2Device& device, const V4l2PixelFormat& format, Size size) {
    const Answer answer = askFormat(device, format, size);
    if (answer.fourcc != format.fourcc || answer.size != size)
        throw std::runtime_error(fmt::format("{}: camera '{}' offers {}x{} {} instead of {}x{} {}",
                                             device.path(), device.card(), answer.size.width,
                                             answer.size.height, fourccText(answer.fourcc),
                                             size.width, size.height, fourccText(format.fourcc)));
    V4l2Layout out;
    out.format = format;
    out.size = size;
    out.memoryPlanes = format.separatePlanes ? planeCount(format.picture) : 1;
    if (answer.memoryPlanes != out.memoryPlanes)
        impossible(device,
                   fmt::format("{} has {} planes", fourccText(format.fourcc), answer.memoryPlanes));
    setColours(answer, out);
    if (!format.jpeg) place(device, answer, out);
    return out;
}

}  // namespace mfar
