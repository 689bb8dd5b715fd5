#pragma once

#include "hal/frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace mfar {

/// Decodes JPEGs of a camera into planes of Y, U and V. Only one thread at a time may call the
/// decoder. Any thread may use the frames.
class JpegDecoder {
public:
    /// Throws std::invalid_argument unless width and height are both positive and even. Throws
    /// std::runtime_error if the JPEG library fails.
    JpegDecoder(Size size, int buffers);

    /// Returns the picture as Yuv420 (BT.601, full range, as JFIF defines) or Gray8. For chroma
    /// subsampled 4:2:2, the mean of two chroma rows is used. Returns nothing if the picture is
    /// damaged or has another size, if its chroma is subsampled otherwise than 4:2:0 or 4:2:2, or
    /// if all buffers are in use (isFull()).
    [[nodiscard]] std::optional<Frame> decode(std::span<const std::uint8_t> jpeg, Timestamp time);
    /// Returns true if the last decode() returned nothing because all buffers were in use.
    [[nodiscard]] bool isFull() const { return isFull_; }

private:
    [[nodiscard]] std::optional<int> subsamplingOf(std::span<const std::uint8_t> jpeg);
    [[nodiscard]] bool decodeInto(std::span<const std::uint8_t> jpeg,
                                  std::array<std::uint8_t*, 3> planes);
    void renew();

    struct Close {
        void operator()(void* handle) const;
    };
    std::unique_ptr<void, Close> handle_;
    FramePool pool_;  // 2 bytes per pixel, because decoding 4:2:2 needs them
    bool isFull_ = false;
};

}  // namespace mfar
