#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mfar {

/// A camera as a library names it.
struct ListedCamera {
    std::string id;           ///< unique, stable over restarts
    std::string model;        ///< may be shared
    std::string location;     ///< "front", "back", "external" or empty
    std::int64_t pixels = 0;  ///< of its largest pictures
};

/// Which of several cameras is meant.
struct CameraWish {
    std::string name{};    ///< id, otherwise location, otherwise model; empty: any
    std::string except{};  ///< never the one of this name
    bool largest = false;  ///< of any: the one with the largest pictures, not the smallest
};

/// One line for messages: "'ID' (model M, location L)", all of them comma-separated.
[[nodiscard]] std::string describe(const std::vector<ListedCamera>& cameras);

/// Index of the camera that is meant. Of any, those with equal pictures go by id, the smallest
/// first: what one asks for with `largest` and what another asks for without are two cameras
/// wherever there are two. Throws std::runtime_error that lists the cameras when the name is none's
/// or several's, or when any is meant and there is one alone, which is then the other's.
[[nodiscard]] std::size_t chooseCamera(const std::vector<ListedCamera>& cameras,
                                       const CameraWish& wish);

}  // namespace mfar
