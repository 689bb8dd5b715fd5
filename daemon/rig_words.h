#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// The source that is made of this board's cameras.
inline constexpr std::string_view kCameras = "cameras";

/// A source's name taken apart: "kind[:scene[,path]]".
struct SourceWords {
    std::string_view kind;
    std::optional<std::string_view> scene;
    std::optional<std::string_view> path;
};
[[nodiscard]] SourceWords sourceWords(std::string_view source);

/// What is wrong with the name of a source or display, nothing when there is such a one. Says which
/// exist. Does not try to open it.
[[nodiscard]] std::optional<std::string> sourceFault(std::string_view source);
[[nodiscard]] std::optional<std::string> displayFault(std::string_view display);

/// A screen of this machine, see openScreen().
[[nodiscard]] bool isScreen(std::string_view display);
/// This display writes every picture that show() took, so its finish() is worth waiting for.
[[nodiscard]] bool keepsPictures(std::string_view display);

}  // namespace mfar
