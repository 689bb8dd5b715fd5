#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// The name of the source that uses the cameras of this machine.
inline constexpr std::string_view kCameras = "cameras";

/// The parts of a source's name, "kind[:scene[,path]]".
struct SourceWords {
    std::string_view kind;
    std::optional<std::string_view> scene;
    std::optional<std::string_view> path;
};
[[nodiscard]] SourceWords sourceWords(std::string_view source);

/// sourceFault() and displayFault() return what is wrong with the name of a source or of a display,
/// with a list of the valid names. They return nothing if the name is valid. They do not open a
/// device.
[[nodiscard]] std::optional<std::string> sourceFault(std::string_view source);
[[nodiscard]] std::optional<std::string> displayFault(std::string_view display);

/// Returns whether a display's name means a screen of this machine, see openScreen().
[[nodiscard]] bool isScreen(std::string_view display);
/// Returns whether the display writes its pictures to a file or pipe, so that a shutdown should
/// wait for Display::finish().
[[nodiscard]] bool keepsPictures(std::string_view display);

}  // namespace mfar
