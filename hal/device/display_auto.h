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

/// A display that may come, go and change at any time. While there is none show() waits for the GPU
/// and shows nothing; once there is one, the picture is on it within a second. Devices are looked
/// for in a fixed order, those that failed with their first picture last.
///
/// A screen is no condition of a run: no device, no permission or a driver too old end nothing,
/// they are in name(), which changes with what happens:
///   "kms:card0,HDMI-A-1,1280x720@60, GBM with fences"
///   "no screen yet (kms: there is no /dev/dri/card0; fbdev: there is no /dev/fb0)"
class ScreenDisplay final : public Display {
public:
    using Clock = std::function<Timestamp()>;
    using Events = std::function<bool()>;

    /// `scaler`: what the screens draw with; kept until they are gone. `screens` in order of
    /// preference. `changed` tells of devices that came, went or changed since the last call; where
    /// it never does, only changes of mode go unnoticed.
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
    /// What name() says while there is no screen; of one that was lost, until it has shown pictures
    /// again.
    [[nodiscard]] std::optional<std::string> fault() const override;

    /// The picture that the last show() sent to the screen, screen-sized, black bars included; on a
    /// screen of 24 or 32 bits a screenshot shows the same to the bit, with 16 bits its upper 5, 6
    /// and 5. Nothing while there is no screen. Waits for the GPU.
    [[nodiscard]] std::optional<ScreenPicture> lastShown() const override;

private:
    void refresh();
    [[nodiscard]] Screen* look(bool changed);
    void lose(const std::string& why);

    std::unique_ptr<ScreenScaler> scaler_;
    std::vector<std::unique_ptr<Screen>> screens_;  // go before the scaler
    Clock clock_;
    Events changed_;
    Screen* active_ = nullptr;
    Screen* failed_ = nullptr;  // could not show its first pictures
    int shown_ = 0;             // pictures, by active_
    std::optional<Timestamp> lookedAt_;
    std::string fault_;  // of the screen that was lost last, until one is proven
};

/// Opens a screen: "auto" (KMS, where none can be used a framebuffer), "kms[:cardN][,CONNECTOR]
/// [,WxH[@Hz]]" or "fbdev[:/dev/fbN]". Once it has been given a texture, it needs the context for
/// its whole life. Throws std::runtime_error for malformed words alone, never for a missing device.
[[nodiscard]] std::unique_ptr<ScreenDisplay> openScreen(std::string_view spec);

}  // namespace mfar
