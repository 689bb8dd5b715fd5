#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mfar::test {

/// A KMS driver without a kernel: a program that links pretended_drm.cpp calls its functions in
/// place of libdrm's. It has one card, with one connector, CRTC and plane, and dumb buffers that
/// lie in the card's file. One per program, used by one thread.
struct PretendedDrm {
    bool connected = true;
    std::uint16_t width = 64, height = 48;  ///< of the only mode
    bool flips = true;                      ///< false: no flip completes
    int otherEvents = 0;        ///< events that arrive, 10 ms apart, before a flip's own
    bool refusesFlips = false;  ///< EBUSY
    int modeSets = 0, flipped = 0, buffers = 0, framebuffers = 0;
    std::uint32_t shown = 0;  ///< framebuffer on the screen
    bool console = false;     ///< the console's picture is on the screen
};

/// Makes a new driver, whose card is the empty file `card`.
PretendedDrm& pretendedDrm(const std::filesystem::path& card);
/// XRGB8888 of the framebuffer on the screen, row-major.
[[nodiscard]] std::vector<std::uint32_t> shownPixels();

}  // namespace mfar::test
