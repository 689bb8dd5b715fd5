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

/// Refresh rate [Hz], from the mode's timing instead of its rounded number. 0: invalid timing.
[[nodiscard]] double refreshHz(const drmModeModeInfo& mode);

/// Chooses a connector's mode. The wanted mode if offered (rate to 0.5 Hz; without a wanted rate
/// the highest; progressive before interlaced); otherwise the preferred mode, or the first. Empty
/// when no mode has sides of 1 to 16384 pixels and a rate.
[[nodiscard]] std::optional<drmModeModeInfo> chooseMode(std::span<const drmModeModeInfo> modes,
                                                        const std::optional<ModeWish>& wish);
[[nodiscard]] bool fulfils(const drmModeModeInfo& mode, const ModeWish& wish);

/// Waits until the picture of the last commit is on the screen; the event of that commit, which got
/// the address of `pending`, sets it to false. False when this takes longer than `limit` or the
/// device is lost.
[[nodiscard]] bool waitForFlip(int fd, bool& pending, std::chrono::milliseconds limit);

/// The properties of one KMS object, by name.
class DrmProperties {
public:
    DrmProperties() = default;
    DrmProperties(int fd, std::uint32_t object, std::uint32_t type);
    /// Throws std::runtime_error when the driver lacks it.
    [[nodiscard]] std::uint32_t id(std::string_view name) const;
    [[nodiscard]] bool has(std::string_view name) const { return ids_.find(name) != ids_.end(); }

private:
    std::map<std::string, std::uint32_t, std::less<>> ids_;
};

/// A complete path from a plane to a monitor that nobody else uses.
struct DrmOutput {
    std::string connectorName;
    drmModeModeInfo mode{};
    std::uint32_t connector = 0, crtc = 0, plane = 0;

    [[nodiscard]] Size size() const { return {mode.hdisplay, mode.vdisplay}; }
};

/// A DRM device with connectors and atomic mode setting, of which this process is DRM master.
class DrmCard {
public:
    /// Throws std::runtime_error with the reason when this device cannot be used.
    explicit DrmCard(const std::string& path);

    [[nodiscard]] int fd() const { return fd_.get(); }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// The wanted connector, or the first connected one, with its mode. `probe`: the driver queries
    /// the monitor, which may take tens of milliseconds; otherwise the driver's last knowledge is
    /// used. Empty when no screen is connected; throws std::runtime_error when the device is gone.
    [[nodiscard]] std::optional<DrmOutput> findOutput(const ScreenSpec& spec, bool probe) const;
    /// The connectors and their states: "HDMI-A-1 disconnected, ..."
    [[nodiscard]] std::string connectors() const;

private:
    [[nodiscard]] std::optional<DrmOutput> route(const drmModeConnector& connector,
                                                 const ScreenSpec& spec) const;
    [[nodiscard]] std::uint32_t primaryPlane(unsigned crtcIndex) const;

    std::string path_;
    OwnedFd fd_;
};

}  // namespace mfar
