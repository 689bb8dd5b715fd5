#include "hal/device/libcamera_manager.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

using libcamera::Camera;
using libcamera::CameraManager;

/// libcamera ends the process if a second manager exists. So a new manager is created only after
/// the previous one was destroyed.
struct OnlyOne {
    std::mutex mutex;
    std::condition_variable gone;
    std::weak_ptr<CameraManager> manager;
    bool exists = false;
};

OnlyOne& onlyOne() {
    static OnlyOne one;
    return one;
}

void end(CameraManager* manager) {
    manager->stop();
    delete manager;
    OnlyOne& one = onlyOne();
    {
        std::lock_guard lock(one.mutex);
        one.exists = false;
    }
    one.gone.notify_all();
}

std::int64_t largestPicture(Camera& camera) {
    std::int64_t most = 0;
    const auto configuration = camera.generateConfiguration({libcamera::StreamRole::StillCapture});
    if (!configuration || configuration->empty()) return most;
    const libcamera::StreamFormats& formats = configuration->at(0).formats();
    for (const auto& format : formats.pixelformats())
        for (const libcamera::Size& size : formats.sizes(format))
            most = std::max(most, std::int64_t{size.width} * size.height);
    return most;
}

std::string locationName(const std::optional<std::int32_t>& location) {
    if (!location) return "";
    switch (*location) {
    case libcamera::properties::CameraLocationFront: return "front";
    case libcamera::properties::CameraLocationBack: return "back";
    case libcamera::properties::CameraLocationExternal: return "external";
    default: return "";
    }
}

}  // namespace

std::shared_ptr<CameraManager> libcameraManager() {
    OnlyOne& one = onlyOne();
    std::unique_lock lock(one.mutex);
    if (auto manager = one.manager.lock()) return manager;
    one.gone.wait(lock, [&] { return !one.exists; });
    auto fresh = std::make_unique<CameraManager>();
    if (const int error = fresh->start(); error != 0)
        throw std::runtime_error("libcamera cannot be started (error " + std::to_string(-error) +
                                 ")");
    one.exists = true;
    const std::shared_ptr<CameraManager> manager(fresh.release(), end);
    one.manager = manager;
    return manager;
}

std::vector<ListedCamera> listCameras(const std::vector<std::shared_ptr<Camera>>& cameras) {
    namespace properties = libcamera::properties;
    std::vector<ListedCamera> listed;
    for (const auto& camera : cameras) {
        const auto& known = camera->properties();
        listed.push_back({camera->id(), libcamera_compat::text(known.get(properties::Model)),
                          locationName(known.get(properties::Location))});
    }
    return listed;
}

std::shared_ptr<Camera> findLibcamera(const CameraManager& manager, const CameraWish& wish) {
    const std::vector<std::shared_ptr<Camera>> cameras = manager.cameras();
    std::vector<ListedCamera> listed = listCameras(cameras);
    // Querying the largest picture sizes takes time, so it is done only if they decide the choice.
    for (std::size_t i = 0; i < cameras.size() && wish.name.empty() && cameras.size() > 1; ++i)
        listed[i].pixels = largestPicture(*cameras[i]);
    return cameras[chooseCamera(listed, wish)];
}

}  // namespace mfar
