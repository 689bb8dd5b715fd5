#pragma once

#include <optional>

namespace mfar {

/// The next action for the shown and the next traced picture.
enum class TracedStep : unsigned char {
    Refine,    ///< trace more samples of the shown picture
    Continue,  ///< trace more samples of the next picture
    Start,     ///< begin a next picture, and discard an unfinished one
    Drop,      ///< discard the next picture: the view is near the shown picture's again
};

/// `sinceShown` is the change since the shown picture. It is the larger of two numbers: changeOf()
/// of PictureScene, from this picture's view to the present view, and the motion of objects divided
/// by its limit. `sinceNext` is PictureScene::changeOf() for the next picture. A value is empty if
/// its picture does not exist or shows other objects; `sinceShown` is also empty if the light has
/// changed. If there is no next picture, one begins when `sinceShown` is empty or at least
/// `renewed`.
[[nodiscard]] TracedStep nextStep(std::optional<double> sinceShown, std::optional<double> sinceNext,
                                  double renewed);

}  // namespace mfar
