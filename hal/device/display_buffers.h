#pragma once

#include "base/owned_fd.h"
#include "hal/device/display_drm.h"
#include "hal/device/display_scaler.h"

#include <memory>

namespace mfar {

/// Ways of transferring pixels to the screen.
enum class ScanoutMethod {
    GbmFenced,  ///< the GPU draws into the screen's memory; the kernel waits for its fence
    Gbm,        ///< the GPU draws into the screen's memory; this process waits for the GPU
    Dumb,       ///< the CPU copies the picture, which the GPU may have drawn into a texture before
};
[[nodiscard]] const char* name(ScanoutMethod method);

/// Screen-sized buffers in the screen's memory, used in turn. Used from one thread; each picture
/// goes through begin() and complete() and must be on the screen before the next complete().
class ScanoutBuffers {
public:
    struct Ready {
        std::uint32_t framebuffer;  ///< DRM framebuffer id
        /// Signalled when the GPU has drawn; invalid: it has drawn already.
        OwnedFd fence;
    };

    virtual ~ScanoutBuffers() = default;

    /// Starts drawing. The previous picture may not be on the screen yet.
    virtual void begin(const Picture& picture) = 0;
    /// Completes the picture begun. The previous picture must be on the screen.
    [[nodiscard]] virtual Ready complete() = 0;
    /// See Display::releaseGl(). Nothing more is drawn into the buffers; the screen keeps its
    /// picture.
    virtual void releaseGl() = 0;
    /// The last picture begun, as sent to the screen.
    [[nodiscard]] virtual ScreenPicture last() const = 0;
};

/// Throws std::runtime_error when this card or the current context does not support the method.
/// `scaler` must outlive the buffers.
[[nodiscard]] std::unique_ptr<ScanoutBuffers>
makeScanoutBuffers(const DrmCard& card, Size size, ScanoutMethod method, ScreenScaler& scaler);

/// Two buffers in dumb memory, which every driver offers.
[[nodiscard]] std::unique_ptr<ScanoutBuffers> makeDumbBuffers(const DrmCard& card, Size size,
                                                              ScreenScaler& scaler);
/// Three GBM buffers, imported into the EGL display of the current context. The card that shows and
/// the GPU that draws may be different devices.
[[nodiscard]] std::unique_ptr<ScanoutBuffers> makeGbmBuffers(const DrmCard& card, Size size,
                                                             bool fences, ScreenScaler& scaler);

/// A DRM framebuffer of one linear XRGB8888 plane. Removed at destruction.
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
