#pragma once

#include "base/geometry.h"

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// The configured size of the finished pictures.
struct PictureSize {
    enum class Fits {
        Screen,  ///< fit to the screen that is connected at the start; without a screen: Still
        Still,   ///< the still's resolution
        Given,
    };
    Fits fits = Fits::Screen;
    Size given{};  ///< for Fits::Given: pictures fit into this size [px]
    bool operator==(const PictureSize&) const = default;
};

/// Parses "screen", "still" or a size such as "1280x720". Returns nothing for other words.
[[nodiscard]] std::optional<PictureSize> pictureSize(std::string_view words);
/// Returns what is wrong with the text of a picture size, or nothing if it is valid.
[[nodiscard]] std::optional<std::string> pictureSizeFault(std::string_view words);

/// Returns the pipeline's output size. It is the largest size that has the video's aspect ratio and
/// fits into the wanted size, but at most the still's size and at least the video's.
[[nodiscard]] Size outputSizeFor(const PictureSize& wanted, const StereoRig& rig,
                                 const std::optional<Size>& screen);

}  // namespace mfar
