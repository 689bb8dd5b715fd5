#pragma once

#include "base/image_view.h"

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

inline constexpr int kMaxScreenSide = 16384;  ///< [px]; larger screens are refused

/// A wanted screen mode.
struct ModeWish {
    Size size;
    std::optional<double> rateHz;  ///< not set: the highest rate of that size
    bool operator==(const ModeWish&) const = default;
};

/// The parsed text of openScreen(), which selects a screen.
struct ScreenSpec {
    enum class Kind { Auto, Kms, Fbdev };
    Kind kind = Kind::Auto;
    std::string device;  ///< e.g. "/dev/dri/card0", "/dev/fb0"; empty: the first usable one
    /// For KMS only: the connector's name as in /sys/class/drm, e.g. "HDMI-A-1"; empty: the first
    /// connector with a monitor.
    std::string connector;
    std::optional<ModeWish> mode;  ///< KMS only; not set: the monitor's preferred mode
    bool operator==(const ScreenSpec&) const = default;
};

/// Parses "auto", "kms[:cardN][,CONNECTOR][,WxH[@Hz]]" or "fbdev[:/dev/fbN]". Throws a
/// std::runtime_error that names the wrong part.
[[nodiscard]] ScreenSpec parseScreenSpec(std::string_view spec);
/// Returns what is wrong with the text of a screen, or nothing if parseScreenSpec() accepts it.
[[nodiscard]] std::optional<std::string> screenFault(std::string_view spec);

/// The position and size of a picture on a screen.
struct ScreenRect {
    int x = 0, y = 0;  ///< [px], top left pixel
    Size size;
    bool operator==(const ScreenRect&) const = default;
};

/// Returns the largest centred rectangle on the screen that has the picture's aspect ratio. Its
/// width and height are rounded and at least 1. The sides of picture and screen must be positive.
[[nodiscard]] ScreenRect letterbox(Size picture, Size screen);

}  // namespace mfar
