#include "hal/device/display_kms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace mfar {
namespace {

using Request = std::unique_ptr<drmModeAtomicReq, FreedBy<drmModeAtomicFree>>;

constexpr std::chrono::milliseconds kFlipTimeout{500};  // 12 periods of a mode with 24 Hz

std::vector<std::string> cardPaths() {
    std::vector<std::string> paths;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/dev/dri", error))
        if (entry.path().filename().string().starts_with("card"))
            paths.push_back(entry.path().string());
    std::ranges::sort(paths);
    return paths;
}

class ModeBlob {
public:
    ModeBlob(int fd, const drmModeModeInfo& mode) : fd_(fd) {
        if (drmModeCreatePropertyBlob(fd, &mode, sizeof mode, &id_) != 0)
            throw std::runtime_error(
                fmt::format("the display driver refuses the mode: {}", std::strerror(errno)));
    }
    ModeBlob(const ModeBlob&) = delete;
    ModeBlob& operator=(const ModeBlob&) = delete;
    ~ModeBlob() { drmModeDestroyPropertyBlob(fd_, id_); }
    [[nodiscard]] std::uint32_t id() const { return id_; }

private:
    int fd_;
    std::uint32_t id_ = 0;
};

void add(drmModeAtomicReq& request, std::uint32_t object, std::uint32_t property,
         std::uint64_t value) {
    if (drmModeAtomicAddProperty(&request, object, property, value) < 0)
        throw std::runtime_error("no memory for a request to the display driver");
}

bool sameOutput(const DrmOutput& a, const DrmOutput& b) {
    return a.connector == b.connector && std::memcmp(&a.mode, &b.mode, sizeof a.mode) == 0;
}

}  // namespace

KmsScreen::KmsScreen(ScreenSpec spec, ScreenScaler& scaler)
    : spec_(std::move(spec)), scaler_(scaler) {}

KmsScreen::~KmsScreen() {
    close();
}

void KmsScreen::openCard() {
    const std::vector<std::string> paths =
        spec_.device.empty() ? cardPaths() : std::vector{spec_.device};
    fault_ = paths.empty() ? "there is no /dev/dri/card0" : "";
    for (const std::string& path : paths) {
        try {
            auto card = std::make_unique<DrmCard>(path);
            const bool connected = card->findOutput(spec_, true).has_value();
            if (!card_ || connected) card_ = std::move(card);
            if (connected) return;
        } catch (const std::runtime_error& error) {
            fault_ += (fault_.empty() ? "" : "; ") + std::string(error.what());
        }
    }
}

Screen::Presence KmsScreen::look(bool thorough) {
    try {
        if (!card_) openCard();
        if (!card_) return Presence::Absent;
        auto found = card_->findOutput(spec_, thorough);
        if (!found && thorough && spec_.device.empty() && cardPaths().size() > 1) {
            // A monitor may have been connected to another card, so the card is chosen anew.
            close();
            openCard();
            if (!card_) return Presence::Absent;
            found = card_->findOutput(spec_, thorough);
        }
        if (!found || (output_ && !sameOutput(*found, *output_))) leaveOutput();
        output_ = std::move(found);
        return output_ ? Presence::Ready : Presence::Waiting;
    } catch (const std::runtime_error& error) {
        fault_ = error.what();
        close();
        return Presence::Absent;
    }
}

Size KmsScreen::size() const {
    return output_ ? output_->size() : Size{};
}

void KmsScreen::show(const Picture& picture) {
    if (!buffers_) {
        startOutput(picture);
        return;
    }
    buffers_->begin(picture);
    waitForLastFlip();
    commit(buffers_->complete(), Commit::Flip);
}

void KmsScreen::startOutput(const Picture& picture) {
    const int fd = card_->fd();
    properties_ = {DrmProperties(fd, output_->connector, DRM_MODE_OBJECT_CONNECTOR),
                   DrmProperties(fd, output_->crtc, DRM_MODE_OBJECT_CRTC),
                   DrmProperties(fd, output_->plane, DRM_MODE_OBJECT_PLANE)};
    if (!left_) saved_.reset(drmModeGetCrtc(fd, output_->crtc));
    std::string faults;
    for (const ScanoutMethod method :
         {ScanoutMethod::GbmFenced, ScanoutMethod::Gbm, ScanoutMethod::Dumb}) {
        if (picture.isOnHost() && method != ScanoutMethod::Dumb) continue;
        try {
            if (method == ScanoutMethod::GbmFenced) (void)properties_.plane.id("IN_FENCE_FD");
            buffers_ = makeScanoutBuffers(*card_, output_->size(), method, scaler_);
            buffers_->begin(picture);
            commit(buffers_->complete(), Commit::ModeSet);
            method_ = method;
            left_.reset();
            return;
        } catch (const std::runtime_error& error) {
            buffers_.reset();
            faults += fmt::format("; {}: {}", name(method), error.what());
        }
    }
    throw std::runtime_error(fmt::format("{}, {}: no picture can be shown{}", card_->path(),
                                         output_->connectorName, faults));
}

void KmsScreen::addModeSet(drmModeAtomicReq& request, std::uint32_t modeBlob) const {
    const std::uint64_t width = output_->mode.hdisplay, height = output_->mode.vdisplay;
    add(request, output_->connector, properties_.connector.id("CRTC_ID"), output_->crtc);
    add(request, output_->crtc, properties_.crtc.id("MODE_ID"), modeBlob);
    add(request, output_->crtc, properties_.crtc.id("ACTIVE"), 1);
    const auto plane = [&](const char* property, std::uint64_t value) {
        add(request, output_->plane, properties_.plane.id(property), value);
    };
    plane("CRTC_ID", output_->crtc);
    plane("SRC_X", 0);
    plane("SRC_Y", 0);
    plane("SRC_W", width << 16);  // 16.16 fixed point
    plane("SRC_H", height << 16);
    plane("CRTC_X", 0);
    plane("CRTC_Y", 0);
    plane("CRTC_W", width);
    plane("CRTC_H", height);
}

void KmsScreen::commit(ScanoutBuffers::Ready ready, Commit kind) {
    const Request request(drmModeAtomicAlloc());
    if (!request) throw std::runtime_error("no memory for a request to the display driver");
    add(*request, output_->plane, properties_.plane.id("FB_ID"), ready.framebuffer);
    if (ready.fence)
        add(*request, output_->plane, properties_.plane.id("IN_FENCE_FD"),
            static_cast<std::uint64_t>(ready.fence.get()));
    std::optional<ModeBlob> mode;
    std::uint32_t flags = DRM_MODE_ATOMIC_NONBLOCK | DRM_MODE_PAGE_FLIP_EVENT;
    if (kind == Commit::ModeSet) {
        mode.emplace(card_->fd(), output_->mode);
        addModeSet(*request, mode->id());
        flags = DRM_MODE_ATOMIC_ALLOW_MODESET;
    }
    if (drmModeAtomicCommit(card_->fd(), request.get(), flags, &flipPending_) != 0)
        throw std::runtime_error(fmt::format("{}, {}: the display driver refuses the picture: {}",
                                             card_->path(), output_->connectorName,
                                             std::strerror(errno)));
    flipPending_ = kind == Commit::Flip;
}

void KmsScreen::waitForLastFlip() {
    if (waitForFlip(card_->fd(), flipPending_, kFlipTimeout)) return;
    // The driver may never report this flip, so later calls must not wait for the report.
    flipPending_ = false;
    throw std::runtime_error(
        fmt::format("{}, {}: the display driver did not show the new picture in time",
                    card_->path(), output_->connectorName));
}

// Waits for the last flip and ignores errors. Without this wait, the report of the flip would later
// be taken for that of another flip.
void KmsScreen::waitForLostFlip() {
    try {
        waitForLastFlip();
    } catch (const std::runtime_error&) {
        // The device is lost or did not report the flip in time. Waiting longer would not help.
    }
}

void KmsScreen::releaseGl() {
    if (!buffers_) return;
    waitForLostFlip();
    buffers_->releaseGl();
    left_ = std::move(buffers_);
}

// The screen's previous picture is restored before the buffers are freed, because freeing a visible
// buffer turns the screen off. Errors are ignored, because a lost device refuses all requests.
void KmsScreen::leaveOutput() {
    if ((buffers_ || left_) && output_) {
        waitForLostFlip();
        if (saved_ && saved_->mode_valid != 0 && saved_->buffer_id != 0)
            drmModeSetCrtc(card_->fd(), saved_->crtc_id, saved_->buffer_id, saved_->x, saved_->y,
                           &output_->connector, 1, &saved_->mode);
    }
    buffers_.reset();
    left_.reset();
    saved_.reset();
    output_.reset();
    flipPending_ = false;
}

void KmsScreen::close() {
    leaveOutput();
    card_.reset();
}

std::string KmsScreen::status() const {
    if (!card_) return "kms: " + (fault_.empty() ? "not in use" : fault_);
    const std::string card = std::filesystem::path(card_->path()).filename().string();
    if (!output_) return fmt::format("kms:{}: no screen connected ({})", card, card_->connectors());
    std::string text =
        fmt::format("kms:{},{},{}x{}@{:.4g}", card, output_->connectorName, output_->mode.hdisplay,
                    output_->mode.vdisplay, refreshHz(output_->mode));
    if (buffers_) text += fmt::format(", {}", name(method_));
    if (spec_.mode && !fulfils(output_->mode, *spec_.mode))
        text += "; the screen does not offer the configured mode";
    return text;
}

std::optional<ScreenPicture> KmsScreen::lastShown() const {
    if (!buffers_) return std::nullopt;
    return buffers_->last();
}

}  // namespace mfar
