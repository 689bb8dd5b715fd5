#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Name of the source for this board's cameras.
inline constexpr std::string_view kCameras = "cameras";

/// The parts of a source's name, "kind[:scene[,path]]".
struct SourceWords {
    std::string_view kind;
    std::optional<std::string_view> scene;
    std::optional<std::string_view> path;
};
[[nodiscard]] SourceWords sourceWords(std::string_view source);

/// The fault in the name of a source or display, with the list of valid names; nothing for a valid
/// name. Opens nothing.
[[nodiscard]] std::optional<std::string> sourceFault(std::string_view source);
[[nodiscard]] std::optional<std::string> displayFault(std::string_view display);

/// True for a screen of this machine, see openScreen().
[[nodiscard]] bool isScreen(std::string_view display);
/// True when the display writes every picture that show() took, so that finish() is worth waiting
/// for.
[[nodiscard]] bool keepsPictures(std::string_view display);

}  // namespace mfar
