#include "tests/device/pretended_drm.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <drm_fourcc.h>
#include <fstream>
#include <map>
#include <set>
#include <string_view>
#include <thread>
#include <utility>
#include <xf86drm.h>
#include <xf86drmMode.h>

namespace {

using mfar::test::PretendedDrm;

// Ids of the KMS objects. The id of a property is kFirstProperty plus its index in kProperties.
constexpr std::uint32_t kCrtc = 10, kConnector = 20, kPlane = 30, kEncoder = 40;
constexpr std::uint32_t kConsole = 99, kFirstProperty = 100;
constexpr std::array<std::string_view, 12> kProperties = {"CRTC_ID", "MODE_ID", "ACTIVE", "FB_ID",
                                                          "SRC_X",   "SRC_Y",   "SRC_W",  "SRC_H",
                                                          "CRTC_X",  "CRTC_Y",  "CRTC_W", "CRTC_H"};
constexpr std::uint32_t kType = kFirstProperty + kProperties.size();

struct DumbBuffer {
    std::uint64_t offset = 0;
    std::uint32_t width = 0, height = 0;
};

struct Driver {
    PretendedDrm seen;
    std::filesystem::path card;
    std::map<std::uint32_t, DumbBuffer> buffers;
    std::map<std::uint32_t, std::uint32_t> framebuffers;
    std::uint32_t next = 1;
    std::map<std::pair<std::uint32_t, std::string_view>, std::uint64_t> asked;
    std::set<std::uint64_t> modes;
    void* flipping = nullptr;
    std::uint64_t end = 0;
};
Driver driver;

// Callers free the results of libdrm's functions through libdrm, which calls free().
template <class T>
T* made(std::size_t count = 1) {
    return static_cast<T*>(std::calloc(count, sizeof(T)));
}
template <class T>
T* listOf(T value) {
    T* out = made<T>();
    *out = value;
    return out;
}

std::uint32_t* twoFrom(std::uint32_t first) {
    auto* out = made<std::uint32_t>(2);
    out[0] = first;
    out[1] = first + 1;
    return out;
}

/// True if the request shows the whole framebuffer on the whole screen. SRC_W and SRC_H are 16.16
/// fixed-point numbers.
bool isModeSet() {
    const std::uint64_t width = driver.seen.width, height = driver.seen.height;
    const auto is = [](std::uint32_t object, std::string_view property, std::uint64_t value) {
        const auto at = driver.asked.find({object, property});
        return at != driver.asked.end() && at->second == value;
    };
    const auto mode = driver.asked.find({kCrtc, "MODE_ID"});
    return mode != driver.asked.end() && driver.modes.contains(mode->second) &&
           is(kConnector, "CRTC_ID", kCrtc) && is(kCrtc, "ACTIVE", 1) &&
           is(kPlane, "CRTC_ID", kCrtc) && is(kPlane, "SRC_X", 0) && is(kPlane, "SRC_Y", 0) &&
           is(kPlane, "SRC_W", width << 16) && is(kPlane, "SRC_H", height << 16) &&
           is(kPlane, "CRTC_X", 0) && is(kPlane, "CRTC_Y", 0) && is(kPlane, "CRTC_W", width) &&
           is(kPlane, "CRTC_H", height);
}

int refused(int error) {
    errno = error;
    return -error;
}

}  // namespace

namespace mfar::test {

PretendedDrm& pretendedDrm(const std::filesystem::path& card) {
    driver = {};
    driver.card = card;
    std::ofstream(card).flush();
    return driver.seen;
}

std::vector<std::uint32_t> shownPixels() {
    const DumbBuffer& from = driver.buffers.at(driver.framebuffers.at(driver.seen.shown));
    std::vector<std::uint32_t> out(std::size_t{from.width} * from.height);
    std::ifstream file(driver.card, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(from.offset));
    file.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(4 * out.size()));
    return out;
}

}  // namespace mfar::test

extern "C" {

int drmIsMaster(int /*fd*/) {
    return 1;
}
int drmSetClientCap(int /*fd*/, std::uint64_t /*capability*/, std::uint64_t /*value*/) {
    return 0;
}

drmModeResPtr drmModeGetResources(int /*fd*/) {
    auto* out = made<drmModeRes>();
    out->count_crtcs = out->count_connectors = driver.seen.secondScreen ? 2 : 1;
    out->crtcs = twoFrom(kCrtc);
    out->connectors = twoFrom(kConnector);
    return out;
}

drmModeConnectorPtr drmModeGetConnector(int /*fd*/, std::uint32_t id) {
    auto* out = made<drmModeConnector>();
    out->connector_id = id;
    out->connector_type = DRM_MODE_CONNECTOR_HDMIA;
    out->connector_type_id = 1;
    out->encoder_id = driver.seen.secondScreen && id == kConnector ? 0 : kEncoder;
    out->connection = driver.seen.connected ? DRM_MODE_CONNECTED : DRM_MODE_DISCONNECTED;
    if (!driver.seen.connected) return out;
    drmModeModeInfo mode{};
    mode.hdisplay = driver.seen.width;
    mode.vdisplay = driver.seen.height;
    mode.vrefresh = 60;
    out->count_modes = 1;
    out->modes = listOf(mode);
    return out;
}
drmModeConnectorPtr drmModeGetConnectorCurrent(int fd, std::uint32_t id) {
    return drmModeGetConnector(fd, id);
}
std::uint32_t drmModeConnectorGetPossibleCrtcs(int /*fd*/, const drmModeConnector* /*connector*/) {
    return driver.seen.secondScreen ? 3 : 1;
}
drmModeEncoderPtr drmModeGetEncoder(int /*fd*/, std::uint32_t id) {
    auto* out = made<drmModeEncoder>();
    out->encoder_id = id;
    out->crtc_id = kCrtc;
    return out;
}
drmModePlaneResPtr drmModeGetPlaneResources(int /*fd*/) {
    auto* out = made<drmModePlaneRes>();
    out->count_planes = driver.seen.secondScreen ? 2 : 1;
    out->planes = twoFrom(kPlane);
    return out;
}
drmModePlanePtr drmModeGetPlane(int /*fd*/, std::uint32_t id) {
    auto* out = made<drmModePlane>();
    out->plane_id = id;
    // Each plane fits every CRTC, as on Snapdragon chips.
    out->possible_crtcs = driver.seen.secondScreen ? 3 : 1;
    out->crtc_id = kCrtc + (id - kPlane);
    out->count_formats = 1;
    out->formats = listOf(std::uint32_t{DRM_FORMAT_XRGB8888});
    return out;
}

drmModeObjectPropertiesPtr drmModeObjectGetProperties(int /*fd*/, std::uint32_t /*object*/,
                                                      std::uint32_t /*type*/) {
    auto* out = made<drmModeObjectProperties>();
    out->count_props = kProperties.size() + 1;
    out->props = made<std::uint32_t>(out->count_props);
    out->prop_values = made<std::uint64_t>(out->count_props);
    for (std::uint32_t i = 0; i < out->count_props; ++i)
        out->props[i] = kFirstProperty + i;
    out->prop_values[kProperties.size()] = DRM_PLANE_TYPE_PRIMARY;
    return out;
}
drmModePropertyPtr drmModeGetProperty(int /*fd*/, std::uint32_t id) {
    auto* out = made<drmModePropertyRes>();
    out->prop_id = id;
    const std::string_view name = id == kType ? "type" : kProperties.at(id - kFirstProperty);
    std::memcpy(out->name, name.data(), name.size());
    return out;
}
int drmModeCreatePropertyBlob(int /*fd*/, const void* /*data*/, std::size_t /*size*/,
                              std::uint32_t* id) {
    *id = driver.next++;
    driver.modes.insert(*id);
    return 0;
}
int drmModeDestroyPropertyBlob(int /*fd*/, std::uint32_t id) {
    driver.modes.erase(id);
    return 0;
}

drmModeCrtcPtr drmModeGetCrtc(int /*fd*/, std::uint32_t id) {
    auto* out = made<drmModeCrtc>();
    out->crtc_id = id;
    out->buffer_id = kConsole;
    out->mode_valid = 1;
    return out;
}
int drmModeSetCrtc(int /*fd*/, std::uint32_t /*crtc*/, std::uint32_t buffer, std::uint32_t /*x*/,
                   std::uint32_t /*y*/, std::uint32_t* /*connectors*/, int /*count*/,
                   drmModeModeInfoPtr /*mode*/) {
    driver.seen.console = buffer == kConsole;
    return 0;
}

int drmModeCreateDumbBuffer(int /*fd*/, std::uint32_t width, std::uint32_t height,
                            std::uint32_t /*bpp*/, std::uint32_t /*flags*/, std::uint32_t* handle,
                            std::uint32_t* pitch, std::uint64_t* size) {
    constexpr std::uint64_t kPage = 65536;
    *handle = driver.next++;
    *pitch = 4 * width - driver.seen.missingPitch;
    *size = std::uint64_t{*pitch} * height;
    driver.buffers[*handle] = {driver.end, width, height};
    driver.end += (*size + kPage - 1) / kPage * kPage;
    std::filesystem::resize_file(driver.card, driver.end);
    ++driver.seen.buffers;
    return 0;
}
int drmModeMapDumbBuffer(int /*fd*/, std::uint32_t handle, std::uint64_t* offset) {
    *offset = driver.buffers.at(handle).offset;
    return 0;
}
int drmModeDestroyDumbBuffer(int /*fd*/, std::uint32_t handle) {
    driver.seen.buffers -= static_cast<int>(driver.buffers.erase(handle));
    return 0;
}
int drmModeAddFB2(int /*fd*/, std::uint32_t /*width*/, std::uint32_t /*height*/,
                  std::uint32_t /*format*/, const std::uint32_t handles[4],
                  const std::uint32_t /*pitches*/[4], const std::uint32_t /*offsets*/[4],
                  std::uint32_t* id, std::uint32_t /*flags*/) {
    *id = driver.next++;
    driver.framebuffers[*id] = handles[0];
    ++driver.seen.framebuffers;
    return 0;
}
int drmModeRmFB(int /*fd*/, std::uint32_t id) {
    driver.seen.framebuffers -= static_cast<int>(driver.framebuffers.erase(id));
    return 0;
}

int drmModeAtomicAddProperty(drmModeAtomicReqPtr /*request*/, std::uint32_t object,
                             std::uint32_t property, std::uint64_t value) {
    driver.asked[{object, kProperties.at(property - kFirstProperty)}] = value;
    return 1;
}
int drmModeAtomicCommit(int /*fd*/, const drmModeAtomicReqPtr /*request*/, std::uint32_t flags,
                        void* data) {
    const auto framebuffer = static_cast<std::uint32_t>(driver.asked[{kPlane, "FB_ID"}]);
    const bool setsMode = isModeSet();
    driver.asked.clear();
    if (driver.framebuffers.count(framebuffer) == 0) return refused(ENOENT);
    if ((flags & DRM_MODE_ATOMIC_ALLOW_MODESET) != 0) {
        if (!setsMode) return refused(EINVAL);
        ++driver.seen.modeSets;
    } else {
        if (driver.seen.refusesFlips || driver.flipping != nullptr) return refused(EBUSY);
        if ((flags & DRM_MODE_PAGE_FLIP_EVENT) != 0) driver.flipping = data;
        if ((flags & DRM_MODE_ATOMIC_NONBLOCK) == 0) ++driver.seen.blockingFlips;
    }
    driver.seen.shown = framebuffer;
    driver.seen.console = false;
    return 0;
}
int drmHandleEvent(int fd, drmEventContextPtr context) {
    if (driver.seen.otherEvents > 0 || !driver.seen.flips) {
        --driver.seen.otherEvents;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return 0;
    }
    if (void* data = std::exchange(driver.flipping, nullptr); data != nullptr) {
        ++driver.seen.flipped;
        context->page_flip_handler2(fd, 0, 0, 0, kCrtc, data);
    }
    return 0;
}
}  // extern "C"
