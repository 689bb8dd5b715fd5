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

/// A copy of a shown picture, rows without padding, row 0 on top.
struct ScreenPicture {
    Size size;
    PixelFormat format = PixelFormat::Rgba8;  ///< or Bgra8
    std::vector<std::uint8_t> pixels;

    [[nodiscard]] ImageView view() const {
        return {pixels.data(), size, static_cast<std::size_t>(size.width) * 4, format};
    }
};

/// The target of finished pictures. Called on one thread. If pictures are textures or the display
/// draws with GL, this is the GL thread with the pipeline's context current. Pictures on the host
/// for a display that the CPU writes need no GL context.
class Display {
public:
    virtual ~Display() = default;

    /// Shows the picture or queues it. May wait for the device's rate; must not keep a texture
    /// after returning. Throws std::runtime_error when the device is lost, GlError when the GPU is
    /// lost.
    virtual void show(const Picture& picture, Timestamp time) = 0;
    /// As show(), for a picture identical to the last one: a screen that already shows it need not
    /// do anything.
    virtual void showAgain(const Picture& picture, Timestamp time) { show(picture, time); }
    /// Releases everything in the GL context, which ends afterwards: the next picture uses another
    /// context or lies on the host.
    virtual void releaseGl() {}
    /// Waits until everything shown has been output (files written). Throws like show().
    virtual void finish() = 0;
    /// The picture that the last show() sent to a screen, screen-sized. Empty without a screen.
    /// Waits for the GPU. Pixels on the host passed to show() must still be valid.
    [[nodiscard]] virtual std::optional<ScreenPicture> lastShown() const { return std::nullopt; }
    /// Size of the current screen, looked for if necessary; empty without a screen.
    [[nodiscard]] virtual std::optional<Size> screenSize() { return std::nullopt; }
    /// Message why some pictures are currently not shown or written; empty when there is no fault.
    /// Call on the thread of show().
    [[nodiscard]] virtual std::optional<std::string> fault() const { return std::nullopt; }
    /// Number of pictures skipped because they came too fast.
    [[nodiscard]] virtual std::uint64_t leftOut() const { return 0; }
    [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace mfar
