#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// A camera as a library names it.
struct ListedCamera {
    std::string id;        ///< unique, stable over restarts
    std::string model;     ///< may be shared
    std::string location;  ///< "front", "back", "external" or empty
};

/// One line for messages: "'ID' (model M, location L)", all of them comma-separated.
[[nodiscard]] std::string describe(const std::vector<ListedCamera>& cameras);

/// Index of the camera that `wanted` names by id, otherwise by location, otherwise by model; empty:
/// the only one there is. Throws std::runtime_error that lists the cameras when it is none or not
/// the only one.
[[nodiscard]] std::size_t chooseCamera(const std::vector<ListedCamera>& cameras,
                                       std::string_view wanted);

}  // namespace mfar
