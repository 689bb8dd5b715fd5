#pragma once

#include "base/owned_fd.h"
#include "hal/device/display_handles.h"
#include "hal/device/display_spec.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <xf86drm.h>
#include <xf86drmMode.h>

namespace mfar {

/// Returns the refresh rate [Hz] from the mode's timing, because the mode's `vrefresh` is rounded.
/// Returns `vrefresh` if the mode has no timing, and 0 if it has neither.
[[nodiscard]] double refreshHz(const drmModeModeInfo& mode);

/// Chooses a connector's mode. Among modes of the wanted size, progressive ones are preferred, then
/// the nearest rate (at most 0.5 Hz away), or the highest rate if the wish has no rate. If no mode
/// fulfils the wish, the monitor's preferred mode is chosen, or else the first mode. Modes without
/// a rate or with a side outside 1 to 16384 pixels are skipped. Returns nothing if no mode is left.
[[nodiscard]] std::optional<drmModeModeInfo> chooseMode(std::span<const drmModeModeInfo> modes,
                                                        const std::optional<ModeWish>& wish);
[[nodiscard]] bool fulfils(const drmModeModeInfo& mode, const ModeWish& wish);

/// Waits until the picture of the last commit is on the screen. The address of `pending` must be
/// the user data of that commit. The commit's event sets `pending` to false. Returns false after
/// `limit` or if the device is lost.
[[nodiscard]] bool waitForFlip(int fd, bool& pending, std::chrono::milliseconds limit);

class DrmProperties {
public:
    DrmProperties() = default;
    DrmProperties(int fd, std::uint32_t object, std::uint32_t type);
    [[nodiscard]] std::uint32_t id(std::string_view name) const;
    [[nodiscard]] bool has(std::string_view name) const { return ids_.find(name) != ids_.end(); }

private:
    std::map<std::string, std::uint32_t, std::less<>> ids_;
};

struct DrmOutput {
    std::string connectorName;
    drmModeModeInfo mode{};
    std::uint32_t connector = 0, crtc = 0, plane = 0;

    [[nodiscard]] Size size() const { return {mode.hdisplay, mode.vdisplay}; }
};

/// A DRM device with connectors and atomic mode setting. This process is its DRM master.
class DrmCard {
public:
    explicit DrmCard(const std::string& path);

    [[nodiscard]] int fd() const { return fd_.get(); }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Returns the connector that `spec` names, or the first connected one if `spec` names none. A
    /// connector that cannot detect a monitor is returned only if no other is connected. Returns
    /// nothing if no connected monitor can be driven. With `probe`, the driver queries the monitor,
    /// which may take tens of milliseconds; otherwise the driver reports the last known state.
    /// Throws std::runtime_error if the device is lost.
    [[nodiscard]] std::optional<DrmOutput> findOutput(const ScreenSpec& spec, bool probe) const;
    [[nodiscard]] std::string connectors() const;

private:
    [[nodiscard]] std::optional<DrmOutput> route(const drmModeConnector& connector,
                                                 const ScreenSpec& spec) const;
    [[nodiscard]] std::uint32_t primaryPlane(unsigned crtcIndex, std::uint32_t crtc) const;

    std::string path_;
    OwnedFd fd_;
};

}  // namespace mfar
