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

/// A supported V4L2 pixel format.
struct V4l2PixelFormat {
    std::uint32_t fourcc;
    PixelFormat picture;
    bool jpeg = false;            ///< has to be decoded
    bool separatePlanes = false;  ///< each plane has its own memory (multi-planar API)
    bool operator==(const V4l2PixelFormat&) const = default;
};

/// In order of preference: formats with luma in its own plane, fewest planes first; then packed
/// formats, smallest first; then JPEG, which costs decoding; last grey, which has no colour.
[[nodiscard]] std::span<const V4l2PixelFormat> usableFormats();

/// The four characters of a format number ("YUYV"), with dots for unprintable ones.
[[nodiscard]] std::string fourccText(std::uint32_t fourcc);

/// The wanted picture size, rate and format.
struct V4l2Wish {
    Size size;
    double rateHz = 0;   ///< 0: the driver's choice
    std::string format;  ///< empty: automatic; otherwise V4L2's four characters, e.g. "YUYV"
};

/// The first supported format that the driver offers at exactly the wanted size and rate; if none
/// reaches the rate, the first at the size. Throws std::runtime_error that lists the offers.
[[nodiscard]] V4l2PixelFormat chooseFormat(const V4l2Device& device, const V4l2Wish& wish);

/// Position of a picture in its buffer, as the driver reported it and validated.
struct V4l2Layout {
    V4l2PixelFormat format{};
    Size size;
    YuvMatrix matrix = YuvMatrix::Bt601;
    YuvRange range = YuvRange::Limited;
    int memoryPlanes = 1;  ///< memory pieces per buffer
    struct Plane {
        int memory = 0;          ///< index of the piece
        std::size_t offset = 0;  ///< bytes from the piece's start
        std::size_t stride = 0;  ///< bytes
    };
    std::array<Plane, 3> planes{};
    /// Minimum size of each memory piece, all of which the driver must have filled [bytes]. 0:
    /// JPEG.
    std::array<std::size_t, 3> bytes{};

    /// The picture in these memory pieces.
    [[nodiscard]] ImageView view(const std::array<const std::uint8_t*, 3>& memory) const;
};

/// Sets size and format and validates the driver's answer. Throws std::runtime_error when size or
/// format differ from the request or the layout is impossible, and DeviceLost.
[[nodiscard]] V4l2Layout setFormat(const V4l2Device& device, const V4l2PixelFormat& format,
                                   Size size);

/// Requests a rate and returns the driver's rate; 0 if the driver does not report it.
[[nodiscard]] double setRate(const V4l2Device& device, double rateHz);

/// Pixels of the largest picture in a supported format; 0 if the driver lists no sizes.
[[nodiscard]] std::int64_t largestPicture(const V4l2Device& device);

/// The V4L2_BUF_TYPE_... for capturing with this device.
[[nodiscard]] std::uint32_t bufferType(const V4l2Device& device);

}  // namespace mfar
