#include "hal/device/camera_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mfar {
namespace {

std::string describe(const ListedCamera& camera) {
    return fmt::format("'{}' (model {}, location {})", camera.id,
                       camera.model.empty() ? "unknown" : camera.model,
                       camera.location.empty() ? "unknown" : camera.location);
}

std::vector<std::size_t> named(const std::vector<ListedCamera>& cameras, std::string_view name) {
    std::vector<std::size_t> found;
    for (const auto key : {&ListedCamera::id, &ListedCamera::location, &ListedCamera::model}) {
        for (std::size_t i = 0; i < cameras.size(); ++i)
            if (cameras[i].*key == name) found.push_back(i);
        if (!found.empty()) break;
    }
    return found;
}

std::size_t anyOf(const std::vector<ListedCamera>& cameras, const CameraWish& wish) {
    std::vector<std::size_t> left(cameras.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    if (!wish.except.empty())
        for (const std::size_t taken : named(cameras, wish.except))
            std::erase(left, taken);
    else if (cameras.size() == 1 && wish.largest && wish.sharesDriver)
        left.clear();
    if (left.empty())
        throw std::runtime_error(
            fmt::format("no second camera was found; available: {}", describe(cameras)));
    const auto [least, most] = std::ranges::minmax(
        left, {}, [&](std::size_t i) { return std::pair(cameras[i].pixels, cameras[i].id); });
    return wish.largest ? most : least;
}

}  // namespace

std::string describe(const std::vector<ListedCamera>& cameras) {
    std::vector<std::string> texts;
    for (const ListedCamera& camera : cameras)
        texts.push_back(describe(camera));
    return fmt::format("{}", fmt::join(texts, ", "));
}

std::size_t chooseCamera(const std::vector<ListedCamera>& cameras, const CameraWish& wish) {
    if (cameras.empty())
        throw std::runtime_error(
            "libcamera finds no camera; for a camera on a CSI connector, install "
            "libcamera-ipa; for other cameras, try driver \"v4l2\"");
    if (wish.name.empty()) return anyOf(cameras, wish);
    const std::vector<std::size_t> found = named(cameras, wish.name);
    if (found.size() == 1) return found[0];
    if (found.size() > 1)
        throw std::runtime_error(
            fmt::format("{} cameras match '{}'; choose one by its id. Available: {}", found.size(),
                        wish.name, describe(cameras)));
    throw std::runtime_error(
        fmt::format("no camera has the id, location or model '{}'; available: {}", wish.name,
                    describe(cameras)));
}

}  // namespace mfar
