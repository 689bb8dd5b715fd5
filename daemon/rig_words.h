#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

inline constexpr std::string_view kCameras = "cameras";

struct SourceWords {
    std::string_view kind;
    std::optional<std::string_view> scene;
    std::optional<std::string_view> path;
};
[[nodiscard]] SourceWords sourceWords(std::string_view source);

/// These functions check the name of a source or display, without opening a device. For an invalid
/// name, they return a message with the valid names. For a valid name, they return nothing.
[[nodiscard]] std::optional<std::string> sourceFault(std::string_view source);
[[nodiscard]] std::optional<std::string> displayFault(std::string_view display);

/// Returns true if the name means a screen of this machine, see openScreen().
[[nodiscard]] bool isScreen(std::string_view display);
/// Returns true if the display writes its pictures to a file or pipe. A shutdown should then wait
/// for Display::finish().
[[nodiscard]] bool keepsPictures(std::string_view display);

}  // namespace mfar
