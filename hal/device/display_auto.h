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

/// A display that may appear, disappear and change at any time. Without a screen, show() waits for
/// the GPU and shows nothing; when a screen appears, the picture is on it within a second. Devices
/// are tried in a fixed order; those that failed with their first picture come last.
///
/// A missing screen never ends a run. A missing device, missing permission or old driver is
/// reported by name(), whose text changes over time:
///   "kms:card0,HDMI-A-1,1280x720@60, GBM with fences"
///   "no screen yet (kms: there is no /dev/dri/card0; fbdev: there is no /dev/fb0)"
class ScreenDisplay final : public Display {
public:
    using Clock = std::function<Timestamp()>;
    using Events = std::function<bool()>;

    /// `scaler` draws for the screens and is kept until they are gone. `screens` are in order of
    /// preference. `changed` reports whether devices came, went or changed since the last call; if
    /// it always returns false, only mode changes go unnoticed.
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
    /// The text of name() while there is no screen; after a lost screen, its fault until pictures
    /// have been shown again.
    [[nodiscard]] std::optional<std::string> fault() const override;

    /// The picture that the last show() sent to the screen, screen-sized, including black bars. A
    /// screenshot of a 24- or 32-bit screen is identical; with 16 bits it has the upper 5, 6 and 5
    /// bits. Empty without a screen. Waits for the GPU.
    [[nodiscard]] std::optional<ScreenPicture> lastShown() const override;

private:
    void refresh();
    [[nodiscard]] Screen* look(bool changed);
    void lose(const std::string& why);

    std::unique_ptr<ScreenScaler> scaler_;
    std::vector<std::unique_ptr<Screen>> screens_;  // destroyed before the scaler
    Clock clock_;
    Events changed_;
    Screen* active_ = nullptr;
    Screen* failed_ = nullptr;  // the screen that could not show its first pictures
    int shown_ = 0;             // pictures shown by active_, at most kProven
    std::optional<Timestamp> lookedAt_;
    std::string fault_;  // of the last lost screen, until another one is proven
};

/// Opens a screen: "auto" (KMS, else a framebuffer), "kms[:cardN][,CONNECTOR][,WxH[@Hz]]" or
/// "fbdev[:/dev/fbN]". After its first texture it needs the GL context for its whole life. Throws
/// std::runtime_error for malformed text only, never for a missing device.
[[nodiscard]] std::unique_ptr<ScreenDisplay> openScreen(std::string_view spec);

}  // namespace mfar
