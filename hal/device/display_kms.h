#pragma once

#include "hal/device/display_buffers.h"
#include "hal/device/display_screen.h"

namespace mfar {

/// A monitor on a DRM/KMS driver with atomic mode setting. show() waits until the previous picture
/// is on the screen. The first picture decides the ScanoutMethod: for a texture, the first method
/// that the driver accepts; for a picture on the host, Dumb. close() restores the picture that the
/// screen showed before.
class KmsScreen final : public Screen {
public:
    /// If `spec.device` is empty, the first card with a connected monitor is used, or else the
    /// first usable card. `scaler` must outlive this object.
    KmsScreen(ScreenSpec spec, ScreenScaler& scaler);
    KmsScreen(const KmsScreen&) = delete;
    KmsScreen& operator=(const KmsScreen&) = delete;
    ~KmsScreen() override;

    Presence look(bool thorough) override;
    [[nodiscard]] Size size() const override;
    void show(const Picture& picture) override;
    void releaseGl() override;
    void close() override;
    [[nodiscard]] std::string status() const override;
    [[nodiscard]] std::optional<ScreenPicture> lastShown() const override;

private:
    using SavedCrtc = std::unique_ptr<drmModeCrtc, FreedBy<drmModeFreeCrtc>>;
    enum class Commit { ModeSet, Flip };
    struct Properties {
        DrmProperties connector, crtc, plane;
    };

    void openCard();
    void leaveOutput();
    void startOutput(const Picture& picture);
    void commit(ScanoutBuffers::Ready ready, Commit kind);
    void addModeSet(drmModeAtomicReq& request, std::uint32_t modeBlob) const;
    void waitForLastFlip();
    void waitForLostFlip();

    ScreenSpec spec_;
    ScreenScaler& scaler_;
    std::string fault_;
    std::unique_ptr<DrmCard> card_;
    std::optional<DrmOutput> output_;
    Properties properties_;
    SavedCrtc saved_;
    std::unique_ptr<ScanoutBuffers> buffers_;
    /// Buffers from before releaseGl(). One of them is on the screen until buffers_ shows a
    /// picture.
    std::unique_ptr<ScanoutBuffers> left_;
    ScanoutMethod method_ = ScanoutMethod::Dumb;
    bool flipPending_ = false;
};

}  // namespace mfar
