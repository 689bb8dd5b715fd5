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

/// A copy of the picture on a screen. Rows have no padding; row 0 is the top row.
struct ScreenPicture {
    Size size;
    PixelFormat format = PixelFormat::Rgba8;  ///< Rgba8 or Bgra8
    std::vector<std::uint8_t> pixels;

    [[nodiscard]] ImageView view() const {
        return {pixels.data(), size, static_cast<std::size_t>(size.width) * 4, format};
    }
};

/// Shows or writes finished pictures. All calls must come from one thread. The pipeline's GL
/// context must be current on this thread if pictures are textures or the display draws with GL.
class Display {
public:
    virtual ~Display() = default;

    /// Shows the picture or queues it. May wait for the screen or for the file. The caller may
    /// change the texture after the call. Throws std::runtime_error if the device is lost, GlError
    /// if the GPU is lost.
    virtual void show(const Picture& picture, Timestamp time) = 0;
    virtual void showAgain(const Picture& picture, Timestamp time) { show(picture, time); }
    /// Releases all GL objects. Must be called before the GL context is destroyed.
    virtual void releaseGl() {}
    /// Waits until all pictures are on the screen or written. Throws like show().
    virtual void finish() = 0;
    /// Returns the picture that the last show() sent to the screen, scaled to the screen's size.
    /// Returns nothing without a screen. Waits for the GPU. If show() got a picture in host memory,
    /// its pixels must still be valid.
    [[nodiscard]] virtual std::optional<ScreenPicture> lastShown() const { return std::nullopt; }
    [[nodiscard]] virtual std::optional<Size> screenSize() { return std::nullopt; }
    /// Returns the reason why pictures are not shown or not written, or nothing if there is no
    /// fault.
    [[nodiscard]] virtual std::optional<std::string> fault() const { return std::nullopt; }
    /// Returns the number of pictures that were skipped because they came too fast.
    [[nodiscard]] virtual std::uint64_t leftOut() const { return 0; }
    [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace mfar
