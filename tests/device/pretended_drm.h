#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mfar::test {

/// A KMS driver without a kernel: a program that links pretended_drm.cpp calls its functions
/// instead of libdrm's. It has one card with one connector, CRTC and plane, and dumb buffers inside
/// the card's file. One per program, used by one thread.
struct PretendedDrm {
    bool connected = true;
    std::uint16_t width = 64, height = 48;  ///< size of the only mode
    bool flips = true;                      ///< false: flips never complete
    int otherEvents = 0;        ///< other events that arrive, 10 ms apart, before the flip's event
    bool refusesFlips = false;  ///< with EBUSY
    int modeSets = 0, flipped = 0, buffers = 0, framebuffers = 0;
    std::uint32_t shown = 0;  ///< framebuffer on the screen
    bool console = false;     ///< the console's picture is on the screen
};

/// Creates a driver whose card is the empty file `card`.
PretendedDrm& pretendedDrm(const std::filesystem::path& card);
/// Pixels (XRGB8888) of the framebuffer on the screen, row-major.
[[nodiscard]] std::vector<std::uint32_t> shownPixels();

}  // namespace mfar::test
