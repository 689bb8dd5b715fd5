#pragma once

#include "base/time.h"
#include "hal/frame.h"
#include "hal/picture.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// A copy of a picture that was shown. Rows have no padding; row 0 is the top row.
struct ScreenPicture {
    Size size;
    PixelFormat format = PixelFormat::Rgba8;  ///< Rgba8 or Bgra8
    std::vector<std::uint8_t> pixels;

    [[nodiscard]] ImageView view() const {
        return {pixels.data(), size, static_cast<std::size_t>(size.width) * 4, format};
    }
};

/// Shows or writes finished pictures. All calls must come from one thread. If pictures are textures
/// or the display draws with GL, the pipeline's GL context must be current on this thread. A
/// display whose memory the CPU writes needs no GL context for pictures on the host.
class Display {
public:
    virtual ~Display() = default;

    /// Shows the picture or queues it. May wait as the screen's refresh rate or the output
    /// requires. After the call, a texture is not used any more. Throws std::runtime_error if the
    /// device is lost, and GlError if the GPU is lost.
    virtual void show(const Picture& picture, Timestamp time) = 0;
    /// Shows a picture that is identical to the last one. A screen that already shows it need not
    /// do anything.
    virtual void showAgain(const Picture& picture, Timestamp time) { show(picture, time); }
    /// Releases all GL objects. Must be called before the GL context is destroyed. The next picture
    /// uses another context or is on the host.
    virtual void releaseGl() {}
    /// Waits until all pictures are on the screen or written. Throws like show().
    virtual void finish() = 0;
    /// Returns the picture that the last show() sent to a screen, in the screen's size. Returns
    /// nothing without a screen. Waits for the GPU. If show() got pixels on the host, they must
    /// still be valid.
    [[nodiscard]] virtual std::optional<ScreenPicture> lastShown() const { return std::nullopt; }
    /// Returns the size of the screen [px], or nothing without a screen. Looks for a screen if
    /// necessary.
    [[nodiscard]] virtual std::optional<Size> screenSize() { return std::nullopt; }
    /// Returns the reason why pictures are currently not shown or not written, or nothing if there
    /// is no fault. Must be called on the thread of show().
    [[nodiscard]] virtual std::optional<std::string> fault() const { return std::nullopt; }
    /// Returns the number of pictures that were not shown or written because they came too fast.
    [[nodiscard]] virtual std::uint64_t leftOut() const { return 0; }
    [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace mfar
