#pragma once

#include "base/geometry.h"

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Size of the finished pictures.
struct PictureSize {
    enum class Fits {
        Screen,  ///< the screen that is connected at the start; without a screen: Still
        Still,   ///< the still's resolution
        Given,
    };
    Fits fits = Fits::Screen;
    Size given{};  ///< finished pictures fit into it
    bool operator==(const PictureSize&) const = default;
};

/// Parses "screen", "still" or "1280x720". Nothing for other words.
[[nodiscard]] std::optional<PictureSize> pictureSize(std::string_view words);
/// The fault of such words; nothing when they are valid.
[[nodiscard]] std::optional<std::string> pictureSizeFault(std::string_view words);

/// The pipeline's output size: the largest of the video's aspect ratio that fits, at most the
/// still's resolution and at least the video's.
[[nodiscard]] Size outputSizeFor(const PictureSize& wanted, const StereoRig& rig,
                                 const std::optional<Size>& screen);

}  // namespace mfar
