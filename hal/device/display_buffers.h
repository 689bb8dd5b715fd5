#pragma once

#include "base/owned_fd.h"
#include "hal/device/display_drm.h"
#include "hal/device/display_scaler.h"

#include <memory>

namespace mfar {

/// How the pixels get to the screen.
enum class ScanoutMethod {
    GbmFenced,  ///< GPU draws into the screen's memory, the kernel waits for a fence of it
    Gbm,        ///< the same, this process waits for the GPU
    Dumb,       ///< the CPU copies it, after the GPU has drawn it into a texture if need be
};
[[nodiscard]] const char* name(ScanoutMethod method);

/// Buffers of a screen's size in the screen's memory, drawn into in turn. Used from one thread;
/// pictures go begin(), complete(), and on the screen before the next complete().
class ScanoutBuffers {
public:
    struct Ready {
        std::uint32_t framebuffer;  ///< DRM framebuffer id
        OwnedFd fence;              ///< signalled when the GPU has drawn; may be none: it has
    };

    virtual ~ScanoutBuffers() = default;

    /// Starts drawing. The picture before may still be on its way to the screen.
    virtual void begin(const Picture& picture) = 0;
    /// The picture begun. The one before must be on the screen by now.
    [[nodiscard]] virtual Ready complete() = 0;
    /// See Display::releaseGl(). Nothing more is drawn into them; what the screen shows stays.
    virtual void releaseGl() = 0;
    /// The picture begun last, as it is sent to the screen.
    [[nodiscard]] virtual ScreenPicture last() const = 0;
};

/// Throws std::runtime_error when this card, or the context that is current, cannot do it so.
/// `scaler` must outlive the buffers.
[[nodiscard]] std::unique_ptr<ScanoutBuffers>
makeScanoutBuffers(const DrmCard& card, Size size, ScanoutMethod method, ScreenScaler& scaler);

/// Two buffers in memory that any driver offers.
[[nodiscard]] std::unique_ptr<ScanoutBuffers> makeDumbBuffers(const DrmCard& card, Size size,
                                                              ScreenScaler& scaler);
/// Three buffers from GBM, imported into the EGL display of the current context. The card that
/// shows and the GPU that draws may be two devices.
[[nodiscard]] std::unique_ptr<ScanoutBuffers> makeGbmBuffers(const DrmCard& card, Size size,
                                                             bool fences, ScreenScaler& scaler);

/// A DRM framebuffer of one linear XRGB8888 plane. Removed at the end.
class DrmFramebuffer {
public:
    /// Throws std::runtime_error when the driver refuses.
    DrmFramebuffer(int fd, Size size, std::uint32_t handle, std::uint32_t pitch);
    DrmFramebuffer(const DrmFramebuffer&) = delete;
    DrmFramebuffer& operator=(const DrmFramebuffer&) = delete;
    ~DrmFramebuffer();
    [[nodiscard]] std::uint32_t id() const { return id_; }

private:
    int fd_;
    std::uint32_t id_ = 0;
};

}  // namespace mfar
