#pragma once

#include "hal/device/display_buffers.h"
#include "hal/device/display_screen.h"

namespace mfar {

/// A monitor on an atomic DRM/KMS driver. One picture in flight: show() waits until the previous
/// picture is on the screen, so its pace is the vertical blank. Uses the first ScanoutMethod that
/// the driver accepts. close() restores the screen's previous picture.
class KmsScreen final : public Screen {
public:
    /// Empty `spec.device`: the first usable card, cards with a connected screen first. `scaler`
    /// must outlive it.
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

    ScreenSpec spec_;
    ScreenScaler& scaler_;
    std::string fault_;
    std::unique_ptr<DrmCard> card_;
    std::optional<DrmOutput> output_;
    Properties properties_;
    SavedCrtc saved_;
    std::unique_ptr<ScanoutBuffers> buffers_;
    /// Shown until buffers_ have their first picture on the screen.
    std::unique_ptr<ScanoutBuffers> left_;
    ScanoutMethod method_ = ScanoutMethod::Dumb;
    bool flipPending_ = false;
};

}  // namespace mfar
