#pragma once

#include "base/image_view.h"

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

inline constexpr int kMaxScreenSide = 16384;  ///< [px]; larger screens are refused

struct ModeWish {
    Size size;
    std::optional<double> rateHz;  ///< not set: the highest rate of that size
    bool operator==(const ModeWish&) const = default;
};

struct ScreenSpec {
    enum class Kind { Auto, Kms, Fbdev };
    Kind kind = Kind::Auto;
    std::string device;  ///< e.g. "/dev/dri/card0", "/dev/fb0"; empty: the first usable device
    /// KMS only: name of the connector, e.g. "HDMI-A-1" for card0-HDMI-A-1 in /sys/class/drm.
    /// Empty: the first connector with a monitor.
    std::string connector;
    std::optional<ModeWish> mode;
    bool operator==(const ScreenSpec&) const = default;
};

[[nodiscard]] ScreenSpec parseScreenSpec(std::string_view spec);
[[nodiscard]] std::optional<std::string> screenFault(std::string_view spec);

struct ScreenRect {
    int x = 0, y = 0;
    Size size;
    bool operator==(const ScreenRect&) const = default;
};

/// Returns the largest centred rectangle on the screen with the picture's aspect ratio. Width and
/// height are rounded and at least 1. The sides of picture and screen must be positive.
[[nodiscard]] ScreenRect letterbox(Size picture, Size screen);

}  // namespace mfar
