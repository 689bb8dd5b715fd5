#pragma once

#include "base/time.h"
#include "hal/device/display_screen.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// A display whose screen may be connected, disconnected or changed at any time. Without a screen,
/// show() prepares the scaler and waits for the GPU. A new screen shows the picture within a
/// second. Devices are checked in order of preference: every half second without a screen, every
/// five seconds while a less preferred device is in use. A device that could not show its first
/// pictures is checked last.
///
/// A missing screen never ends a run. name() reports the screen or the reason why there is none,
/// for example:
///   "kms:card0,HDMI-A-1,1280x720@60, GBM with fences"
///   "no screen yet (kms: there is no /dev/dri/card0; fbdev: there is no /dev/fb0)"
class ScreenDisplay final : public Display {
public:
    using Clock = std::function<Timestamp()>;
    using Events = std::function<bool()>;

    /// `screens` are in order of preference; `scaler` draws the pictures of all of them. `changed`
    /// returns true if a device was added, removed or changed since its last call. If it always
    /// returns false, new modes of the monitor in use may be missed, and a more preferred screen is
    /// found up to about five seconds after it appears.
    ScreenDisplay(std::unique_ptr<ScreenScaler> scaler,
                  std::vector<std::unique_ptr<Screen>> screens, Clock clock, Events changed);
    ScreenDisplay(const ScreenDisplay&) = delete;
    ScreenDisplay& operator=(const ScreenDisplay&) = delete;
    ~ScreenDisplay() override;

    void show(const Picture& picture, Timestamp time) override;
    void finish() override {}
    void releaseGl() override;
    [[nodiscard]] std::optional<Size> screenSize() override;
    void showAgain(const Picture& picture, Timestamp time) override;
    [[nodiscard]] std::string name() const override;
    /// Returns why pictures may not be visible, or nothing. While there is no screen, returns
    /// name(). While a new screen has not yet shown its first pictures, returns why the previous
    /// screen was lost.
    [[nodiscard]] std::optional<std::string> fault() const override;

    /// Returns the picture that the last show() sent to the screen, with its black borders. Returns
    /// nothing without a screen. Waits for the GPU. A screen with 16 bits per pixel shows only the
    /// upper 5, 6 and 5 bits of red, green and blue.
    [[nodiscard]] std::optional<ScreenPicture> lastShown() const override;

private:
    void refresh();
    [[nodiscard]] Screen* look(bool changed);
    [[nodiscard]] bool retriesPreferred();
    void lose(const std::string& why);

    std::unique_ptr<ScreenScaler> scaler_;
    std::vector<std::unique_ptr<Screen>> screens_;
    Clock clock_;
    Events changed_;
    Screen* active_ = nullptr;
    Screen* failed_ = nullptr;
    int shown_ = 0;
    std::optional<Timestamp> lookedAt_;
    std::optional<Timestamp> retriedAt_;  ///< last check of devices that are preferred to active_
    std::string fault_;  // reason why the last screen was lost; empty once a screen works again
};

/// Opens a screen. `spec` is "auto" (KMS, or a framebuffer device if KMS cannot be used),
/// "kms[:cardN][,CONNECTOR][,WxH[@Hz]]" or "fbdev[:/dev/fbN]". Once the display has shown a
/// texture, the GL context must exist until releaseGl() or destruction. Throws std::runtime_error
/// if `spec` is malformed, but never for a missing device.
[[nodiscard]] std::unique_ptr<ScreenDisplay> openScreen(std::string_view spec);

}  // namespace mfar
