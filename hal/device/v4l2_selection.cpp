#include "hal/device/v4l2_selection.h"

#include "hal/device/v4l2_formats.h"

#include <fmt/format.h>

#include <system_error>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mfar {
namespace {

struct Captures {
    std::vector<V4l2Device> devices;
    std::string listed;
};

std::string lineOf(const V4l2Device& device) {
    return fmt::format("\n  {}: '{}' at {}", device.path(), device.card(), device.bus());
}

Captures capturesOf(V4l2Api& api) {
    Captures out;
    for (const std::string& path : api.nodes()) {
        try {
            V4l2Device device(api, path);
            if (!device.captures()) continue;
            out.listed += lineOf(device);
            out.devices.push_back(std::move(device));
        } catch (const V4l2Error& error) {
            out.listed += fmt::format("\n  {}", error.what());
        }
    }
    if (out.listed.empty()) out.listed = " no video devices";
    return out;
}

// `name` may also be a symbolic link to the device, such as those in /dev/v4l/by-id.
bool isNamed(const V4l2Device& device, const std::string& name) {
    std::error_code error;
    return device.card() == name || device.bus() == name || device.path() == name ||
           (name.starts_with("/") && std::filesystem::canonical(name, error) == device.path());
}

// Returns false if the device has no supported format (e.g. a sensor that gives only raw Bayer
// data), or if it has no video input. A capture device without a video input is the output of a
// chip that converts pictures.
bool looksLikeCamera(const V4l2Device& device) {
    v4l2_input input{};
    return device.tryCall(VIDIOC_ENUMINPUT, &input) != ENOTTY && hasUsableFormat(device);
}

V4l2Device anyOf(Captures captures, const CameraWish& wish) {
    std::vector<V4l2Device>& devices = captures.devices;
    std::erase_if(devices, [](const V4l2Device& one) { return !looksLikeCamera(one); });
    if (devices.empty())
        throw std::runtime_error("no camera was found; available:" + captures.listed);
    if (wish.except.empty() && wish.largest && wish.sharesDriver && devices.size() == 1)
        devices.clear();
    if (!wish.except.empty())
        std::erase_if(devices, [&](const V4l2Device& one) { return isNamed(one, wish.except); });
    if (devices.empty())
        throw std::runtime_error("no second camera was found; available:" + captures.listed);
    const auto size = [](const V4l2Device& one) {
        return std::pair(largestPicture(one), one.path());
    };
    const auto [least, most] = std::ranges::minmax_element(devices, {}, size);
    return std::move(wish.largest ? *most : *least);
}

}  // namespace

V4l2Device openCapture(V4l2Api& api, const CameraWish& wish) {
    if (wish.name.starts_with("/")) {
        V4l2Device device(api, wish.name);
        if (!device.captures())
            throw std::runtime_error(
                fmt::format("{}: '{}' is not a capture device", wish.name, device.card()));
        return device;
    }
    Captures captures = capturesOf(api);
    if (wish.name.empty()) return anyOf(std::move(captures), wish);
    std::erase_if(captures.devices,
                  [&](const V4l2Device& one) { return !isNamed(one, wish.name); });
    if (captures.devices.empty())
        throw std::runtime_error(
            fmt::format("camera '{}' was not found; available:{}", wish.name, captures.listed));
    std::string fitting;
    for (const V4l2Device& device : captures.devices)
        fitting += lineOf(device);
    if (captures.devices.size() > 1)
        throw std::runtime_error(fmt::format(
            "several cameras match '{}'; choose one by its path or bus:{}", wish.name, fitting));
    return std::move(captures.devices.front());
}

}  // namespace mfar
