#pragma once

#include "base/image_view.h"
#include "hal/device/v4l2_device.h"

#include <linux/videodev2.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// A pixel format of V4L2 that can be used.
struct V4l2PixelFormat {
    std::uint32_t fourcc;
    PixelFormat picture;
    bool jpeg = false;            ///< to be decoded
    bool separatePlanes = false;  ///< each plane in memory of its own (multi-planar API)
    bool operator==(const V4l2PixelFormat&) const = default;
};

/// In order of preference: those with luma in a plane of its own first, of these the ones with the
/// fewest planes; then the packed ones, the smaller first; then JPEG, which costs decoding; grey at
/// the end, as it has no colour.
[[nodiscard]] std::span<const V4l2PixelFormat> usableFormats();

/// "YUYV" of the number, with dots for what cannot be printed.
[[nodiscard]] std::string fourccText(std::uint32_t fourcc);

/// What is wanted of a camera.
struct V4l2Wish {
    Size size;
    double rateHz = 0;   ///< 0: whatever the driver does
    std::string format;  ///< "" = automatic, else the four characters of V4L2, e.g. "YUYV"
};

/// The first usable format that the driver offers at exactly the wanted size and rate; if none
/// reaches the rate, the first at the size. Throws std::runtime_error that lists what is offered.
[[nodiscard]] V4l2PixelFormat chooseFormat(const V4l2Device& device, const V4l2Wish& wish);

/// How a picture lies in its buffer, as the driver said and as was checked.
struct V4l2Layout {
    V4l2PixelFormat format{};
    Size size;
    YuvMatrix matrix = YuvMatrix::Bt601;
    YuvRange range = YuvRange::Limited;
    int memoryPlanes = 1;  ///< pieces of memory a buffer has
    struct Plane {
        int memory = 0;          ///< in which piece
        std::size_t offset = 0;  ///< bytes from its begin
        std::size_t stride = 0;  ///< bytes
    };
    std::array<Plane, 3> planes{};
    /// Bytes that each piece of memory must have, and that the driver must have filled. 0: JPEG.
    std::array<std::size_t, 3> bytes{};

    /// The picture in these pieces of memory.
    [[nodiscard]] ImageView view(const std::array<const std::uint8_t*, 3>& memory) const;
};

/// Sets size and format and takes what the driver answers. Throws std::runtime_error when that is
/// another size or format than asked for, or a layout that cannot be, and DeviceLost.
[[nodiscard]] V4l2Layout setFormat(const V4l2Device& device, const V4l2PixelFormat& format,
                                   Size size);

/// Asks for a rate and returns the one that the driver will keep; 0 when it does not say.
[[nodiscard]] double setRate(const V4l2Device& device, double rateHz);

/// Pixels of the largest picture in a usable format; 0 where the driver lists no sizes.
[[nodiscard]] std::int64_t largestPicture(const V4l2Device& device);

/// V4L2_BUF_TYPE_... of the device's captures.
[[nodiscard]] std::uint32_t bufferType(const V4l2Device& device);

}  // namespace mfar
