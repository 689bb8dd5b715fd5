#pragma once

#include "hal/frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace mfar {

/// Decodes the pictures of a camera that sends JPEG, into planes, without a detour over RGB. One
/// thread at a time; the frames may go anywhere.
class JpegDecoder {
public:
    /// Even width and height. Throws std::invalid_argument, std::runtime_error.
    JpegDecoder(Size size, int buffers);

    /// YUV420, full range BT.601 (JFIF), chroma of 4:2:2 averaged over two rows; or grey. Nothing
    /// for what is damaged, has another size or another subsampling, and when all buffers are lent.
    [[nodiscard]] std::optional<Frame> decode(std::span<const std::uint8_t> jpeg, Timestamp time);

private:
    [[nodiscard]] std::optional<int> subsamplingOf(std::span<const std::uint8_t> jpeg);
    [[nodiscard]] bool decodeInto(std::span<const std::uint8_t> jpeg,
                                  std::array<std::uint8_t*, 3> planes);
    void renew();

    struct Close {
        void operator()(void* handle) const;
    };
    std::unique_ptr<void, Close> handle_;
    FramePool pool_;  // of 2 bytes a pixel, what 4:2:2 needs
};

}  // namespace mfar
