#pragma once

#include <cstdint>
#include <libcamera/libcamera.h>
#include <optional>
#include <string>
#include <string_view>

/// All differences between libcamera 0.0.3 (Debian 12), 0.4.0 (Debian 13) and 0.7. They are
/// detected from its types, in templates, because a failing `requires` is allowed only there.
namespace mfar::libcamera_compat {

/// The sensor's mode can be chosen (since 0.2.0).
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

/// True for frames of a sensor that has not settled; marked since 0.5.2.
template <typename Metadata>
[[nodiscard]] bool isStartup(const Metadata& metadata) {
    if constexpr (requires { Metadata::FrameStartup; })
        return metadata.status == Metadata::FrameStartup;
    else
        return false;
}

/// Looks up a value's name; controls have named values since 0.4.0.
template <typename Id>
[[nodiscard]] std::optional<std::int32_t> enumerator(const Id& control, std::string_view name) {
    if constexpr (requires { control.enumerators(); }) {
        for (const auto& [value, called] : control.enumerators())
            if (called == name) return value;
    }
    return std::nullopt;
}

/// True for a control with several values. Reported since 0.4.0; before, only one such control is
/// known.
template <typename Id>
[[nodiscard]] bool isArray(const Id& control) {
    if constexpr (requires { control.isArray(); })
        return control.isArray();
    else
        return control.name() == "FrameDurationLimits";
}

/// True if libcamera has controls of this C++ type: 16 and 32 bit unsigned ones since 0.4.0.
template <typename T>
[[nodiscard]] constexpr bool hasControlType() {
    return requires { libcamera::details::control_type<T>::value; };
}

/// A text property; a string view since 0.6.0.
template <typename Text>
[[nodiscard]] std::string text(const std::optional<Text>& property) {
    return property ? std::string(*property) : std::string();
}

}  // namespace mfar::libcamera_compat
