#pragma once

#include "base/geometry.h"

#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// How large finished pictures are.
struct PictureSize {
    enum class Fits {
        Screen,  ///< the screen that is there at the start; none: Still
        Still,   ///< the still's resolution
        Given,
    };
    Fits fits = Fits::Screen;
    Size given{};  ///< pictures lie inside it
    bool operator==(const PictureSize&) const = default;
};

/// "screen", "still" or "1280x720". Nothing for other words.
[[nodiscard]] std::optional<PictureSize> pictureSize(std::string_view words);
/// What is wrong with such words; nothing when they are good.
[[nodiscard]] std::optional<std::string> pictureSizeFault(std::string_view words);

/// The pipeline's output: the largest of the video's aspect ratio that fits, no larger than the
/// still's resolution and no smaller than the video.
[[nodiscard]] Size outputSizeFor(const PictureSize& wanted, const StereoRig& rig,
                                 const std::optional<Size>& screen);

}  // namespace mfar
