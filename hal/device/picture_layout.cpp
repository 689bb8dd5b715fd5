#include "hal/device/picture_layout.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace mfar {
namespace {

struct Plane {
    std::size_t stride = 0;
    std::size_t rowBytes = 0;
    std::size_t rows = 0;

    [[nodiscard]] std::size_t padded() const { return stride * rows; }
    [[nodiscard]] std::size_t least() const { return stride * (rows - 1) + rowBytes; }
};

struct Planes {
    std::array<Plane, 3> plane{};
    std::size_t count = 1;
};

Planes planesOf(const PictureLayout& layout) {
    const auto width = static_cast<std::size_t>(layout.size.width);
    const auto height = static_cast<std::size_t>(layout.size.height);
    Planes planes;
    planes.plane[0] = {layout.stride, width * bytesPerPixel(layout.format), height};
    if (layout.format == PixelFormat::Nv12) {
        planes.plane[1] = {layout.stride, width, height / 2};
        planes.count = 2;
    } else if (layout.format == PixelFormat::Yuv420) {
        planes.plane[1] = planes.plane[2] = {layout.stride / 2, width / 2, height / 2};
        planes.count = 3;
    }
    return planes;
}

void check(const PictureLayout& layout) {
    const bool sound = layout.size.width > 1 && layout.size.height > 1;
    const auto row = static_cast<std::size_t>(layout.size.width) * bytesPerPixel(layout.format);
    if (!sound || layout.stride < row)
        throw std::runtime_error(
            fmt::format("a camera picture of {}x{} cannot have {} bytes per row", layout.size.width,
                        layout.size.height, layout.stride));
}

}  // namespace

std::size_t leastBytes(const PictureLayout& layout) {
    check(layout);
    const Planes planes = planesOf(layout);
    std::size_t before = 0;
    for (std::size_t i = 0; i + 1 < planes.count; ++i)
        before += planes.plane[i].padded();
    return before + planes.plane[planes.count - 1].least();
}

ImageView layOut(const PictureLayout& layout, std::span<const PlaneBytes> planes) {
    const std::size_t least = leastBytes(layout);
    const Planes wanted = planesOf(layout);
    const bool together = planes.size() == 1;
    if (!together && planes.size() < wanted.count)
        throw std::runtime_error(
            fmt::format("the camera's buffer has {} planes; its pixel format needs {}",
                        planes.size(), wanted.count));
    std::array<PlaneView, 3> views{};
    std::size_t offset = 0;
    for (std::size_t i = 0; i < wanted.count; ++i) {
        const PlaneBytes& bytes = planes[together ? 0 : i];
        const std::size_t needed = together ? least : wanted.plane[i].least();
        if (!bytes.data || bytes.length < needed)
            throw std::runtime_error(
                fmt::format("a plane of the camera's buffer has {} bytes; a picture needs {}",
                            bytes.length, needed));
        views[i] = {bytes.data + offset, wanted.plane[i].stride};
        if (together) offset += wanted.plane[i].padded();
    }
    return {views[0].data,        layout.size,   layout.stride, layout.format,
            {views[1], views[2]}, layout.matrix, layout.range};
}

}  // namespace mfar
