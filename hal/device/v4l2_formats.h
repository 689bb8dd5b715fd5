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

struct V4l2PixelFormat {
    std::uint32_t fourcc;
    PixelFormat picture;
    bool jpeg = false;
    /// True: each plane of the picture is a V4L2 plane of its own (multi-planar API).
    bool separatePlanes = false;
    bool operator==(const V4l2PixelFormat&) const = default;
};

/// Returns the supported formats in order of preference: luma in a separate plane (fewest planes
/// first), packed (smallest first), JPEG (decoding takes time), grey.
[[nodiscard]] std::span<const V4l2PixelFormat> usableFormats();

/// Returns the four characters of a format's number, without spaces at the end, e.g. "YUYV".
/// Unprintable characters become dots.
[[nodiscard]] std::string fourccText(std::uint32_t fourcc);

struct V4l2Wish {
    Size size;
    double rateHz = 0;   ///< [Hz]; 0: the driver chooses the rate
    std::string format;  ///< V4L2's four characters, e.g. "YUYV"; empty: automatic
};

/// Returns the first supported format that the driver offers in exactly the wanted size, preferably
/// one that reaches the wanted frame rate. If the driver lists no sizes of a format, or no rates,
/// all count as offered. If no format has the size, throws std::runtime_error whose message lists
/// the driver's formats and sizes.
[[nodiscard]] V4l2PixelFormat chooseFormat(const V4l2Device& device, const V4l2Wish& wish);

struct V4l2Layout {
    V4l2PixelFormat format{};
    Size size;
    YuvMatrix matrix = YuvMatrix::Bt601;
    YuvRange range = YuvRange::Limited;
    int memoryPlanes = 1;
    struct Plane {
        int memory = 0;
        std::size_t offset = 0;
        std::size_t stride = 0;
    };
    std::array<Plane, 3> planes{};
    /// For each V4L2 plane, the number of its bytes in a complete picture. 0 for JPEG, whose size
    /// varies.
    std::array<std::size_t, 3> bytes{};

    [[nodiscard]] ImageView view(const std::array<const std::uint8_t*, 3>& memory) const;
};

/// Sets size and format, and validates the layout that the driver reports. Throws
/// std::runtime_error if the driver chose another size or format or if its layout is impossible.
/// Throws DeviceLost.
[[nodiscard]] V4l2Layout setFormat(const V4l2Device& device, const V4l2PixelFormat& format,
                                   Size size);

/// Requests a frame rate [Hz], unless `rateHz` is 0 or the driver's rate cannot be set. Returns the
/// rate that the driver uses [Hz], or 0 if the driver does not report it.
[[nodiscard]] double setRate(const V4l2Device& device, double rateHz);

/// Returns true if the device offers a format that CameraV4l2 can use.
[[nodiscard]] bool hasUsableFormat(const V4l2Device& device);

/// Returns the number of pixels of the largest picture in a supported format, or 0 if the driver
/// lists no sizes.
[[nodiscard]] std::int64_t largestPicture(const V4l2Device& device);

[[nodiscard]] std::uint32_t bufferType(const V4l2Device& device);

}  // namespace mfar
