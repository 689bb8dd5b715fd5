#include "hal/device/display_drm.h"

#include "base/time.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <drm_fourcc.h>
#include <filesystem>
#include <stdexcept>
#include <tuple>

namespace mfar {
namespace {

using Resources = std::unique_ptr<drmModeRes, FreedBy<drmModeFreeResources>>;
using Connector = std::unique_ptr<drmModeConnector, FreedBy<drmModeFreeConnector>>;
using Encoder = std::unique_ptr<drmModeEncoder, FreedBy<drmModeFreeEncoder>>;
using Plane = std::unique_ptr<drmModePlane, FreedBy<drmModeFreePlane>>;
using Planes = std::unique_ptr<drmModePlaneRes, FreedBy<drmModeFreePlaneResources>>;
using ObjectProperties =
    std::unique_ptr<drmModeObjectProperties, FreedBy<drmModeFreeObjectProperties>>;
using Property = std::unique_ptr<drmModePropertyRes, FreedBy<drmModeFreeProperty>>;

constexpr double kSameRateHz = 0.5;

bool usable(const drmModeModeInfo& mode) {
    return mode.hdisplay >= 1 && mode.vdisplay >= 1 && mode.hdisplay <= kMaxScreenSide &&
           mode.vdisplay <= kMaxScreenSide && refreshHz(mode) > 0;
}

std::string nameOf(const drmModeConnector& connector) {
    const char* type = drmModeGetConnectorTypeName(connector.connector_type);
    return fmt::format("{}-{}", type != nullptr ? type : "Unknown", connector.connector_type_id);
}

std::string cardFault(const std::string& path) {
    if (errno == EACCES)
        return path +
               ": no permission, the user must be in group video, and in render to use the GPU";
    return path + ": " + std::strerror(errno);
}

Resources resources(int fd) {
    return Resources(drmModeGetResources(fd));
}

Connector connectorOf(int fd, std::uint32_t id, bool probe) {
    return Connector(probe ? drmModeGetConnector(fd, id) : drmModeGetConnectorCurrent(fd, id));
}

std::uint32_t currentCrtc(int fd, const drmModeConnector& connector) {
    if (connector.encoder_id == 0) return 0;
    const Encoder encoder(drmModeGetEncoder(fd, connector.encoder_id));
    return encoder ? encoder->crtc_id : 0;
}

std::vector<std::uint32_t> crtcsOfOthers(int fd, const drmModeRes& all, std::uint32_t connector) {
    std::vector<std::uint32_t> out;
    for (int i = 0; i < all.count_connectors; ++i) {
        if (all.connectors[i] == connector) continue;
        const Connector other = connectorOf(fd, all.connectors[i], false);
        const std::uint32_t crtc = other ? currentCrtc(fd, *other) : 0;
        if (crtc != 0) out.push_back(crtc);
    }
    return out;
}

std::optional<std::uint64_t> propertyValue(int fd, std::uint32_t object, std::uint32_t type,
                                           std::string_view name) {
    const ObjectProperties all(drmModeObjectGetProperties(fd, object, type));
    for (std::uint32_t i = 0; all && i < all->count_props; ++i) {
        const Property property(drmModeGetProperty(fd, all->props[i]));
        if (property && name == property->name) return all->prop_values[i];
    }
    return std::nullopt;
}

bool isMaster(int fd) {
    return drmIsMaster(fd) != 0 || drmSetMaster(fd) == 0;
}

// Drops this process's role as DRM master of a card and returns true if it had the role. Mesa's
// software renderer may have opened the card first in this process. The kernel then made the
// process DRM master, although the renderer does not need that role.
bool dropMasterOfThisProcess(const std::string& path) {
    struct stat card{};
    bool dropped = false;
    if (stat(path.c_str(), &card) != 0) return false;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
        const int fd = std::atoi(entry.path().filename().c_str());
        struct stat file{};
        if (fstat(fd, &file) == 0 && S_ISCHR(file.st_mode) && file.st_rdev == card.st_rdev &&
            drmIsMaster(fd) != 0 && drmDropMaster(fd) == 0)
            dropped = true;
    }
    return dropped;
}

void onFlip(int, unsigned, unsigned, unsigned, unsigned, void* pending) {
    *static_cast<bool*>(pending) = false;
}

OwnedFd openCard(const std::string& path) {
    OwnedFd fd(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    if (!fd) throw std::runtime_error(cardFault(path));
    return fd;
}

}  // namespace

double refreshHz(const drmModeModeInfo& mode) {
    const double pixels = static_cast<double>(mode.htotal) * mode.vtotal;
    if (!(pixels > 0) || mode.clock == 0) return mode.vrefresh;
    double hz = mode.clock * 1000.0 / pixels;
    if ((mode.flags & DRM_MODE_FLAG_INTERLACE) != 0) hz *= 2;
    if ((mode.flags & DRM_MODE_FLAG_DBLSCAN) != 0) hz /= 2;
    if (mode.vscan > 1) hz /= mode.vscan;
    return hz;
}

bool fulfils(const drmModeModeInfo& mode, const ModeWish& wish) {
    return mode.hdisplay == wish.size.width && mode.vdisplay == wish.size.height &&
           (!wish.rateHz || std::abs(refreshHz(mode) - *wish.rateHz) <= kSameRateHz);
}

std::optional<drmModeModeInfo> chooseMode(std::span<const drmModeModeInfo> modes,
                                          const std::optional<ModeWish>& wish) {
    const auto rank = [&](const drmModeModeInfo& mode) {
        const bool wanted = wish && fulfils(mode, *wish);
        const bool progressive = (mode.flags & DRM_MODE_FLAG_INTERLACE) == 0;
        double rate = 0;
        if (wanted)
            rate = wish->rateHz ? -std::abs(refreshHz(mode) - *wish->rateHz) : refreshHz(mode);
        const bool preferred = (mode.type & DRM_MODE_TYPE_PREFERRED) != 0;
        return std::tuple(wanted, wanted && progressive, rate, preferred);
    };
    const drmModeModeInfo* best = nullptr;
    for (const drmModeModeInfo& mode : modes)
        if (usable(mode) && (best == nullptr || rank(mode) > rank(*best))) best = &mode;
    if (best == nullptr) return std::nullopt;
    return *best;
}

bool waitForFlip(int fd, bool& pending, std::chrono::milliseconds limit) {
    drmEventContext events{};
    events.version = 3;
    events.page_flip_handler2 = onFlip;
    const Timestamp end = Timestamp::now() + limit;
    while (pending) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Timestamp::now());
        pollfd waiting{fd, POLLIN, 0};
        const int count = poll(&waiting, 1, std::max(static_cast<int>(left.count()), 0));
        if (count < 0 && errno == EINTR) continue;
        const bool told = count > 0 && (waiting.revents & POLLIN) != 0;
        if (!told || drmHandleEvent(fd, &events) != 0) return false;
        // Events of other commits must not extend the wait beyond `limit`.
        if (pending && left.count() <= 0) return false;
    }
    return true;
}

DrmProperties::DrmProperties(int fd, std::uint32_t object, std::uint32_t type) {
    const ObjectProperties all(drmModeObjectGetProperties(fd, object, type));
    for (std::uint32_t i = 0; all && i < all->count_props; ++i) {
        const Property property(drmModeGetProperty(fd, all->props[i]));
        if (property) ids_[property->name] = property->prop_id;
    }
}

std::uint32_t DrmProperties::id(std::string_view name) const {
    const auto found = ids_.find(name);
    if (found == ids_.end())
        throw std::runtime_error(fmt::format("the display driver has no property {}", name));
    return found->second;
}

DrmCard::DrmCard(const std::string& path) : path_(path), fd_(openCard(path)) {
    // A process without privileges becomes DRM master only when it opens a card that has no master.
    // So after dropping the role, the card is opened again.
    if (!isMaster(fd()) && dropMasterOfThisProcess(path)) fd_ = openCard(path);
    const Resources all = resources(fd());
    if (!all || all->count_connectors == 0)
        throw std::runtime_error(path + ": this GPU has no connectors for screens");
    if (drmSetClientCap(fd(), DRM_CLIENT_CAP_ATOMIC, 1) != 0)
        throw std::runtime_error(
            path + ": its driver lacks atomic mode setting, which display \"kms\" needs");
    if (!isMaster(fd()))
        throw std::runtime_error(path +
                                 ": another program, perhaps a desktop, controls the screen");
}

std::optional<DrmOutput> DrmCard::findOutput(const ScreenSpec& spec, bool probe) const {
    const Resources all = resources(fd());
    if (!all) throw std::runtime_error(fmt::format("{}: {}", path_, std::strerror(errno)));
    // Outputs that cannot detect a screen, such as composite video, are used if there is no other.
    for (const drmModeConnection state : {DRM_MODE_CONNECTED, DRM_MODE_UNKNOWNCONNECTION})
        for (int i = 0; i < all->count_connectors; ++i) {
            const Connector connector = connectorOf(fd(), all->connectors[i], probe);
            if (!connector || connector->connection != state) continue;
            if (!spec.connector.empty() && spec.connector != nameOf(*connector)) continue;
            if (auto output = route(*connector, spec)) return output;
        }
    return std::nullopt;
}

std::optional<DrmOutput> DrmCard::route(const drmModeConnector& connector,
                                        const ScreenSpec& spec) const {
    const std::span modes(connector.modes, static_cast<std::size_t>(connector.count_modes));
    const auto mode = chooseMode(modes, spec.mode);
    const Resources all = resources(fd());
    if (!mode || !all) return std::nullopt;
    const std::uint32_t possible = drmModeConnectorGetPossibleCrtcs(fd(), &connector);
    const std::uint32_t current = currentCrtc(fd(), connector);
    const std::vector<std::uint32_t> taken = crtcsOfOthers(fd(), *all, connector.connector_id);
    // The connector's own CRTC is best, then a free one. One that drives another screen is the last
    // choice, because most drivers refuse to show one picture on two screens.
    const auto rank = [&](std::uint32_t crtc) {
        if (crtc == current) return 2;
        return std::ranges::find(taken, crtc) == taken.end() ? 1 : 0;
    };
    std::optional<DrmOutput> found;
    for (int i = 0; i < std::min(all->count_crtcs, 32); ++i) {
        const std::uint32_t crtc = all->crtcs[i];
        if ((possible >> i & 1U) == 0 || (found && rank(crtc) <= rank(found->crtc))) continue;
        const std::uint32_t plane = primaryPlane(static_cast<unsigned>(i), crtc);
        if (plane != 0)
            found = DrmOutput{nameOf(connector), *mode, connector.connector_id, crtc, plane};
    }
    return found;
}

// On some chips, every primary plane fits every CRTC. The CRTC's current plane is preferred, then a
// free one: the driver refuses to take a plane from another CRTC.
std::uint32_t DrmCard::primaryPlane(unsigned crtcIndex, std::uint32_t crtc) const {
    const Planes all(drmModeGetPlaneResources(fd()));
    std::uint32_t free = 0, used = 0;
    for (std::uint32_t i = 0; all && i < all->count_planes; ++i) {
        const Plane plane(drmModeGetPlane(fd(), all->planes[i]));
        if (!plane || (plane->possible_crtcs >> crtcIndex & 1U) == 0) continue;
        const std::span formats(plane->formats, plane->count_formats);
        if (std::ranges::find(formats, DRM_FORMAT_XRGB8888) == formats.end()) continue;
        if (propertyValue(fd(), plane->plane_id, DRM_MODE_OBJECT_PLANE, "type") ==
            DRM_PLANE_TYPE_PRIMARY) {
            if (plane->crtc_id == crtc) return plane->plane_id;
            std::uint32_t& other = plane->crtc_id == 0 ? free : used;
            if (other == 0) other = plane->plane_id;
        }
    }
    return free != 0 ? free : used;
}

std::string DrmCard::connectors() const {
    const Resources all = resources(fd());
    std::string text;
    for (int i = 0; all && i < all->count_connectors; ++i) {
        const Connector connector = connectorOf(fd(), all->connectors[i], false);
        if (!connector) continue;
        const char* const state = connector->connection == DRM_MODE_CONNECTED      ? "connected"
                                  : connector->connection == DRM_MODE_DISCONNECTED ? "disconnected"
                                                                                   : "unknown";
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", nameOf(*connector), state);
    }
    return text;
}

}  // namespace mfar
