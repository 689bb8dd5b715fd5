#pragma once

#include "hal/frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace mfar {

/// Decodes the pictures of a JPEG camera into planes, without converting to RGB. One thread at a
/// time; any thread may use the frames.
class JpegDecoder {
public:
    /// `size` must be even. Throws std::invalid_argument, std::runtime_error.
    JpegDecoder(Size size, int buffers);

    /// YUV420, full range BT.601 (JFIF), chroma of 4:2:2 averaged over two rows; or grey. Empty for
    /// a damaged picture, another size or subsampling, and when all buffers are lent.
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
    FramePool pool_;  // 2 bytes a pixel, as 4:2:2 needs
};

}  // namespace mfar
