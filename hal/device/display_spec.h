#pragma once

#include "base/image_view.h"

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

inline constexpr int kMaxScreenSide = 16384;  ///< [px]; a larger screen is taken for a fault

/// The mode somebody wants on a screen.
struct ModeWish {
    Size size;
    std::optional<double> rateHz;  ///< nothing: the highest of that size
    bool operator==(const ModeWish&) const = default;
};

/// Which screen to use: the words of openScreen(), taken apart.
struct ScreenSpec {
    enum class Kind { Auto, Kms, Fbdev };
    Kind kind = Kind::Auto;
    std::string device;  ///< "/dev/dri/card0", "/dev/fb0"; empty: the first that serves
    std::string
        connector;  ///< kms only: "HDMI-A-1" as in /sys/class/drm; empty: the first connected
    std::optional<ModeWish> mode;  ///< kms only; nothing: the preferred one
    bool operator==(const ScreenSpec&) const = default;
};

/// "auto", "kms[:cardN][,CONNECTOR][,WxH[@Hz]]" or "fbdev[:/dev/fbN]".
/// Throws std::runtime_error that names the word it does not understand.
[[nodiscard]] ScreenSpec parseScreenSpec(std::string_view spec);
/// What is wrong with such words; nothing when parseScreenSpec() takes them.
[[nodiscard]] std::optional<std::string> screenFault(std::string_view spec);

/// Where a picture goes on a screen.
struct ScreenRect {
    int x = 0, y = 0;  ///< [px] of the top left pixel
    Size size;
    bool operator==(const ScreenRect&) const = default;
};

/// The largest centred rectangle with the aspect of `picture`, to the nearest pixel and at least
/// one pixel wide and high. Both sizes must be positive.
[[nodiscard]] ScreenRect letterbox(Size picture, Size screen);

}  // namespace mfar
