#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mfar {

struct ListedCamera {
    std::string id;  ///< unique and the same after a restart
    std::string model;
    std::string location;
    std::int64_t pixels = 0;
};

struct CameraWish {
    std::string name{};  ///< id, location or model; empty: any camera
    /// If `name` is empty: id, location or model of a camera that must not be chosen.
    std::string except{};
    /// If `name` is empty: true chooses the camera with the largest pictures, false the one with
    /// the smallest.
    bool largest = false;
    /// True if both sensors' cameras are used through the same driver. If there is only one camera,
    /// it then belongs to the video sensor, and the still sensor gets none.
    bool sharesDriver = true;
};

[[nodiscard]] std::string describe(const std::vector<ListedCamera>& cameras);

/// Returns the index of the camera that has wish.name. If that is empty, returns the camera with
/// the smallest or largest pictures, see CameraWish::largest. The id decides among equal sizes.
/// Throws std::runtime_error in these cases:
///   - There is no camera.
///   - No camera or several cameras have the name.
///   - No name is given, and all cameras are excluded by CameraWish::except.
///   - Neither a name nor `except` is given, there is only one camera, and `largest` and
///     `sharesDriver` are set: this camera belongs to the video sensor.
/// In all cases but the first, the message lists the cameras.
[[nodiscard]] std::size_t chooseCamera(const std::vector<ListedCamera>& cameras,
                                       const CameraWish& wish);

}  // namespace mfar
