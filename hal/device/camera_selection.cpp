#include "hal/device/camera_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace mfar {
namespace {

std::string describe(const ListedCamera& camera) {
    return fmt::format("'{}' (model {}, location {})", camera.id,
                       camera.model.empty() ? "unknown" : camera.model,
                       camera.location.empty() ? "unknown" : camera.location);
}

}  // namespace

std::string describe(const std::vector<ListedCamera>& cameras) {
    std::vector<std::string> texts;
    for (const ListedCamera& camera : cameras)
        texts.push_back(describe(camera));
    return fmt::format("{}", fmt::join(texts, ", "));
}

std::size_t chooseCamera(const std::vector<ListedCamera>& cameras, std::string_view wanted) {
    if (cameras.empty())
        throw std::runtime_error("libcamera finds no camera; cameras that it does not serve may "
                                 "work with driver \"v4l2\"");
    for (const auto key : {&ListedCamera::id, &ListedCamera::location, &ListedCamera::model}) {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < cameras.size(); ++i)
            if (wanted.empty() || cameras[i].*key == wanted) found.push_back(i);
        if (found.size() == 1) return found[0];
        if (found.size() > 1)
            throw std::runtime_error(
                fmt::format("{} cameras are meant by '{}', give an id: there are {}", found.size(),
                            wanted, describe(cameras)));
    }
    throw std::runtime_error(fmt::format(
        "no camera has the id, location or model '{}': there are {}", wanted, describe(cameras)));
}

}  // namespace mfar
