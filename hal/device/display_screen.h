#pragma once

#include "hal/device/display_scaler.h"

#include <optional>
#include <string>

namespace mfar {

/// One way to a screen: a kind of device that may be absent, without a screen, or lost at any time.
/// Used from the thread of Display::show().
class Screen {
public:
    enum class Presence {
        Absent,   ///< no device that could be used; another way may be tried
        Waiting,  ///< the device is held, but no screen is connected to it
        Ready,    ///< show() may be called
    };

    virtual ~Screen() = default;

    /// Looks for the device and, once it is held, for changes of it. `thorough`: also asks what
    /// takes a while (reading a monitor's data), to be done only when something has changed. Never
    /// throws for a device: what is missing is in status().
    virtual Presence look(bool thorough) = 0;
    /// In pixels. Only after look() said Ready.
    [[nodiscard]] virtual Size size() const = 0;
    /// Shows a picture, at the pace of the screen. Only after look() said Ready.
    /// Throws std::runtime_error when the screen is lost; close() it then.
    virtual void show(const Picture& picture) = 0;
    /// See Display::releaseGl(). What the screen shows stays there.
    virtual void releaseGl() = 0;
    /// Gives the device back as it was found. Idempotent.
    virtual void close() = 0;
    /// "kms:card0,HDMI-A-1,1280x720@60 ..." while ready, otherwise what is missing.
    [[nodiscard]] virtual std::string status() const = 0;
    /// What the last show() sent to the screen, before packing into fewer bits.
    [[nodiscard]] virtual std::optional<ScreenPicture> lastShown() const = 0;
};

}  // namespace mfar
