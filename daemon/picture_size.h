#pragma once

#include "base/geometry.h"

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

struct PictureSize {
    enum class Fits {
        Screen,  ///< fits the screen that is connected at the start; without a screen: Still
        Still,
        Given,
    };
    Fits fits = Fits::Screen;
    Size given{};
    bool operator==(const PictureSize&) const = default;
};

/// Parses "screen", "still" or a size such as "1280x720". Returns nothing for any other text.
[[nodiscard]] std::optional<PictureSize> pictureSize(std::string_view words);
[[nodiscard]] std::optional<std::string> pictureSizeFault(std::string_view words);

/// Returns the pipeline's output size. It has the video's aspect ratio. For Fits::Still, it is as
/// wide as the still. Otherwise, it is the largest size that fits into the screen or the given
/// size, but never wider than the still or narrower than the video.
[[nodiscard]] Size outputSizeFor(const PictureSize& wanted, const StereoRig& rig,
                                 const std::optional<Size>& screen);

}  // namespace mfar
