#pragma once

#include "hal/device/display_scaler.h"

#include <optional>
#include <string>

namespace mfar {

/// A device that drives a screen, such as KMS or fbdev. It may be missing or lost at any time. All
/// calls come from the thread of Display::show().
class Screen {
public:
    enum class Presence {
        Absent,
        Waiting,  ///< the device is held, but no screen is connected to it
        Ready,
    };

    virtual ~Screen() = default;

    /// Looks for the device, or checks whether an open device has changed. `thorough` includes slow
    /// queries such as reading the monitor's data, so do not use it in every call. Does not throw
    /// for a missing device.
    virtual Presence look(bool thorough) = 0;
    /// Returns the screen's size [px]. May be called only after look() returned Ready.
    [[nodiscard]] virtual Size size() const = 0;
    /// Shows a picture and waits as the screen's refresh rate requires. May be called only after
    /// look() returned Ready. Throws std::runtime_error if the screen is lost; then close() must be
    /// called.
    virtual void show(const Picture& picture) = 0;
    virtual void releaseGl() = 0;
    /// Restores the device's previous state and releases it. Idempotent.
    virtual void close() = 0;
    /// Returns a text such as "kms:card0,HDMI-A-1,1280x720@60 ..." if the screen is ready,
    /// otherwise the reason why it is not ready.
    [[nodiscard]] virtual std::string status() const = 0;
    [[nodiscard]] virtual std::optional<ScreenPicture> lastShown() const = 0;
};

}  // namespace mfar
