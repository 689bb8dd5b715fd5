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

/// Where finished pictures go. Called on one thread; where pictures are textures, or the display
/// draws with GL, that is the GL thread with the pipeline's context current. Pictures on the host
/// that go to a display which is written by the CPU take no GL: there need be no context.
class Display {
public:
    virtual ~Display() = default;

    /// Shows the picture (or queues it for that). May wait for the device's pace; must not keep a
    /// texture after returning. Throws std::runtime_error when the device is lost, GlError where
    /// the GPU is.
    virtual void show(const Picture& picture, Timestamp time) = 0;
    /// The same where the picture is the last one, to the bit: a screen that shows it needs
    /// nothing.
    virtual void showAgain(const Picture& picture, Timestamp time) { show(picture, time); }
    /// Lets go of all that it has on the GL context, which ends after this: the next picture comes
    /// with another one, or lies on the host.
    virtual void releaseGl() {}
    /// Blocks until everything shown is out (files written). Throws like show().
    virtual void finish() = 0;
    /// What the last show() sent to a screen, screen-sized. Nothing where there is no screen. Waits
    /// for the GPU. Pixels on the host that it got must still be there.
    [[nodiscard]] virtual std::optional<ScreenPicture> lastShown() const { return std::nullopt; }
    /// Of the screen that pictures go to, looked for if need be; nothing where there is none now.
    [[nodiscard]] virtual std::optional<Size> screenSize() { return std::nullopt; }
    /// Why not every picture is seen or written at present, for people; nothing when all is well.
    /// To be asked on the thread of show().
    [[nodiscard]] virtual std::optional<std::string> fault() const { return std::nullopt; }
    /// Pictures that came too fast and were left out, so far.
    [[nodiscard]] virtual std::uint64_t leftOut() const { return 0; }
    [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace mfar
