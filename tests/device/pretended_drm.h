#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mfar::test {

/// A simulated KMS driver. A program that links pretended_drm.cpp calls it instead of libdrm. It
/// has one card with one connector, CRTC and plane, or with two of each (`secondScreen`). Dumb
/// buffers are in the card's file. It refuses a mode set that does not show the whole framebuffer
/// on the whole screen. A program has one driver, used by one thread.
struct PretendedDrm {
    bool connected = true;
    std::uint16_t width = 64, height = 48;
    bool flips = true;    ///< false: flips never complete
    int otherEvents = 0;  ///< number of other events before the event of the flip, 10 ms apart
    bool refusesFlips = false;
    std::uint32_t missingPitch = 0;  ///< rows of dumb buffers are too short by this [bytes]
    int modeSets = 0, flipped = 0, buffers = 0, framebuffers = 0;
    int blockingFlips = 0;  ///< number of flips for which the caller had to wait
    std::uint32_t shown = 0;
    /// True: a second connector exists. The first CRTC drives the second connector, and no CRTC
    /// drives the first connector.
    bool secondScreen = false;
    bool console = false;  ///< true while the console's picture is on the screen
};

PretendedDrm& pretendedDrm(const std::filesystem::path& card);
/// Pixels (XRGB8888) of the framebuffer that is on the screen, row by row.
[[nodiscard]] std::vector<std::uint32_t> shownPixels();

}  // namespace mfar::test
