#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mfar {

/// A camera as the camera library lists it.
struct ListedCamera {
    std::string id;           ///< unique and the same after a restart
    std::string model;        ///< model; several cameras may have the same one
    std::string location;     ///< "front", "back", "external" or empty
    std::int64_t pixels = 0;  ///< number of pixels of the camera's largest picture
};

/// What the user states to choose one of several cameras.
struct CameraWish {
    std::string name{};    ///< an id, a location or a model; empty: any camera
    std::string except{};  ///< the name of a camera that must not be chosen
    /// If `name` is empty: choose the camera with the largest instead of the smallest pictures.
    bool largest = false;
};

/// Returns a list for messages: "'ID' (model M, location L)" for each camera, separated by commas.
[[nodiscard]] std::string describe(const std::vector<ListedCamera>& cameras);

/// Returns the index of the chosen camera. If wish.name is empty, the cameras are ordered by
/// picture size, then by id. wish.largest chooses the last of them; otherwise the first is chosen.
/// So the video camera and the still camera are different cameras. Throws a std::runtime_error that
/// lists the cameras if none or several have the name, if `except` is the only camera, or if
/// `largest` is set and there is only one camera.
[[nodiscard]] std::size_t chooseCamera(const std::vector<ListedCamera>& cameras,
                                       const CameraWish& wish);

}  // namespace mfar
