#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mfar {

/// A camera's names, as a library reports them.
struct ListedCamera {
    std::string id;           ///< unique, stable over restarts
    std::string model;        ///< not unique
    std::string location;     ///< "front", "back", "external" or empty
    std::int64_t pixels = 0;  ///< number of pixels of its largest picture
};

/// Selects one of several cameras.
struct CameraWish {
    std::string name{};    ///< id, else location, else model; empty: any camera
    std::string except{};  ///< never choose the camera of this name
    /// If `name` is empty: choose the largest pictures instead of the smallest.
    bool largest = false;
};

/// One line for messages: "'ID' (model M, location L)" of each camera, separated by commas.
[[nodiscard]] std::string describe(const std::vector<ListedCamera>& cameras);

/// Index of the chosen camera. An empty name orders the cameras by picture size, then id; `largest`
/// takes the last, otherwise the first is taken, so that of two cameras each choice gets another
/// one. Throws std::runtime_error that lists the cameras when no camera or several have the name,
/// or when no camera is left: `except` is the only one, or `largest` would take the only camera.
[[nodiscard]] std::size_t chooseCamera(const std::vector<ListedCamera>& cameras,
                                       const CameraWish& wish);

}  // namespace mfar
