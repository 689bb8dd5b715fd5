#pragma once

#include "hal/device/display_scaler.h"

#include <optional>
#include <string>

namespace mfar {

/// One kind of screen device, which may be absent, without a screen, or lost at any time. Used from
/// the thread of Display::show().
class Screen {
public:
    enum class Presence {
        Absent,   ///< no usable device; another kind may be tried
        Waiting,  ///< the device is held, but no screen is connected to it
        Ready,    ///< show() may be called
    };

    virtual ~Screen() = default;

    /// Looks for the device or, once it is held, for changes of it. `thorough`: includes slow
    /// queries (reading a monitor's data), to be used only after a change. Never throws for a
    /// missing device: status() reports it.
    virtual Presence look(bool thorough) = 0;
    /// [px]. Only after look() returned Ready.
    [[nodiscard]] virtual Size size() const = 0;
    /// Shows a picture at the screen's rate. Only after look() returned Ready. Throws
    /// std::runtime_error when the screen is lost; call close() then.
    virtual void show(const Picture& picture) = 0;
    /// See Display::releaseGl(). The screen keeps its picture.
    virtual void releaseGl() = 0;
    /// Restores the device's previous state and releases it. Idempotent.
    virtual void close() = 0;
    /// "kms:card0,HDMI-A-1,1280x720@60 ..." when ready, otherwise the reason why not.
    [[nodiscard]] virtual std::string status() const = 0;
    /// The picture that the last show() sent to the screen, before packing into fewer bits.
    [[nodiscard]] virtual std::optional<ScreenPicture> lastShown() const = 0;
};

}  // namespace mfar
