#pragma once

#include "base/owned_fd.h"
#include "hal/device/display_drm.h"
#include "hal/device/display_scaler.h"

#include <memory>

namespace mfar {

enum class ScanoutMethod {
    GbmFenced,  ///< the GPU draws into the screen's memory; the kernel waits for the GPU's fence
    Gbm,        ///< the GPU draws into the screen's memory; this process waits for the GPU
    Dumb,       ///< the CPU copies the picture into the screen's memory
};
[[nodiscard]] const char* name(ScanoutMethod method);

/// Buffers of the screen's size. The screen shows them in turn. All calls must come from one
/// thread. For each picture, call begin(), then complete().
class ScanoutBuffers {
public:
    struct Ready {
        std::uint32_t framebuffer;
        /// Signalled when the GPU has drawn the picture. Invalid: the picture is already drawn.
        OwnedFd fence;
    };

    virtual ~ScanoutBuffers() = default;

    /// Starts to draw a picture. The previous picture need not be on the screen yet.
    virtual void begin(const Picture& picture) = 0;
    /// Completes the picture of the last begin(). Before the call, the previous picture must have
    /// appeared on the screen.
    [[nodiscard]] virtual Ready complete() = 0;
    /// Releases all GL objects, see Display::releaseGl(). After that, begin() must not be called.
    /// The screen keeps its picture.
    virtual void releaseGl() = 0;
    [[nodiscard]] virtual ScreenPicture last() const = 0;
};

/// Throws std::runtime_error if the card or the current GL context does not support the method.
/// `scaler` must outlive the buffers.
[[nodiscard]] std::unique_ptr<ScanoutBuffers>
makeScanoutBuffers(const DrmCard& card, Size size, ScanoutMethod method, ScreenScaler& scaler);

[[nodiscard]] std::unique_ptr<ScanoutBuffers> makeDumbBuffers(const DrmCard& card, Size size,
                                                              ScreenScaler& scaler);
/// Allocates three GBM buffers and imports them into the EGL display of the current GL context. The
/// card that drives the screen and the GPU that draws may be different devices.
[[nodiscard]] std::unique_ptr<ScanoutBuffers> makeGbmBuffers(const DrmCard& card, Size size,
                                                             bool fences, ScreenScaler& scaler);

class DrmFramebuffer {
public:
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
