#pragma once

#include "base/image_view.h"

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

inline constexpr int kMaxScreenSide = 16384;  ///< [px]; a larger screen counts as a fault

/// A wanted screen mode.
struct ModeWish {
    Size size;
    std::optional<double> rateHz;  ///< empty: the highest rate of that size
    bool operator==(const ModeWish&) const = default;
};

/// Selects a screen: the parsed text of openScreen().
struct ScreenSpec {
    enum class Kind { Auto, Kms, Fbdev };
    Kind kind = Kind::Auto;
    std::string device;  ///< "/dev/dri/card0", "/dev/fb0"; empty: the first usable device
    std::string
        connector;  ///< kms only: "HDMI-A-1" as in /sys/class/drm; empty: the first connected
    std::optional<ModeWish> mode;  ///< kms only; empty: the preferred mode
    bool operator==(const ScreenSpec&) const = default;
};

/// Parses "auto", "kms[:cardN][,CONNECTOR][,WxH[@Hz]]" or "fbdev[:/dev/fbN]". Throws
/// std::runtime_error that names the faulty part.
[[nodiscard]] ScreenSpec parseScreenSpec(std::string_view spec);
/// The fault in such a text; empty if parseScreenSpec() accepts it.
[[nodiscard]] std::optional<std::string> screenFault(std::string_view spec);

/// Position of a picture on a screen.
struct ScreenRect {
    int x = 0, y = 0;  ///< [px], top left pixel
    Size size;
    bool operator==(const ScreenRect&) const = default;
};

/// The largest centred rectangle with the aspect of `picture`, to the nearest pixel and at least
/// one pixel wide and high. Both sizes must be positive.
[[nodiscard]] ScreenRect letterbox(Size picture, Size screen);

}  // namespace mfar
