#pragma once

#include <cstdint>
#include <libcamera/libcamera.h>
#include <optional>
#include <string>
#include <string_view>

/// Handles all differences between libcamera 0.0.3 (Debian 12), 0.4.0 (Debian 13) and 0.7. All
/// functions are templates, because an unsatisfied `requires` outside of a template is an error.
namespace mfar::libcamera_compat {

template <typename Configuration = libcamera::CameraConfiguration>
[[nodiscard]] constexpr bool hasSensorConfiguration() {
    return requires(Configuration& c) { c.sensorConfig; };
}

template <typename Configuration>
void setSensorMode(Configuration& configuration, libcamera::Size size, unsigned bitDepth) {
    if constexpr (hasSensorConfiguration<Configuration>()) {
        auto& mode = configuration.sensorConfig.emplace();
        mode.outputSize = size;
        mode.bitDepth = bitDepth;
    }
}

/// Returns true if a frame was taken before the sensor had settled (reported since libcamera
/// 0.5.2).
template <typename Metadata>
[[nodiscard]] bool isStartup(const Metadata& metadata) {
    if constexpr (requires { Metadata::FrameStartup; })
        return metadata.status == Metadata::FrameStartup;
    else
        return false;
}

/// Returns the number of a control's value, e.g. of "AfModeManual". Values have names since
/// libcamera 0.4.0.
template <typename Id>
[[nodiscard]] std::optional<std::int32_t> enumerator(const Id& control, std::string_view name) {
    if constexpr (requires { control.enumerators(); }) {
        for (const auto& [value, called] : control.enumerators())
            if (called == name) return value;
    }
    return std::nullopt;
}

/// Returns true if a control has several values. libcamera reports this since 0.4.0. For older
/// versions, returns true only for FrameDurationLimits, which controlsFor() sets.
template <typename Id>
[[nodiscard]] bool isArray(const Id& control) {
    if constexpr (requires { control.isArray(); })
        return control.isArray();
    else
        return control.name() == "FrameDurationLimits";
}

template <typename T>
[[nodiscard]] constexpr bool hasControlType() {
    return requires { libcamera::details::control_type<T>::value; };
}

template <typename Text>
[[nodiscard]] std::string text(const std::optional<Text>& property) {
    return property ? std::string(*property) : std::string();
}

}  // namespace mfar::libcamera_compat
