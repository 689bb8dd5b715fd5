#pragma once

#include "base/owned_fd.h"
#include "hal/device/display_pixels.h"
#include "hal/device/display_screen.h"
#include "hal/device/display_spec.h"

#include <linux/fb.h>

#include <memory>
#include <vector>

namespace mfar {

/// The validated layout of a framebuffer device's memory. All rows of all pages lie inside it.
/// `visible` is the offset [bytes] of the pixel that the driver now shows at the top left of the
/// screen. `page0` is the offset [bytes] of the pixel that it shows there after panning to row 0.
struct FbGeometry {
    Size size;
    PixelLayout layout;
    std::size_t stride = 0;
    std::size_t bytes = 0;
    std::size_t visible = 0;
    std::size_t page0 = 0;
    int pages = 1;  ///< 2: a second page lies below the first
    bool operator==(const FbGeometry&) const = default;
};

/// Throws std::runtime_error if the format is not true or direct colour with 16, 24 or 32 bits, if
/// the screen is empty or too large, or if the driver's numbers contradict each other.
[[nodiscard]] FbGeometry checkedGeometry(const fb_var_screeninfo& var,
                                         const fb_fix_screeninfo& fix);

/// A Linux framebuffer device, /dev/fbN. The GPU scales pictures that are textures; the CPU scales
/// pictures on the host. The CPU then copies the result to the screen's memory. If the driver can
/// pan, the copy goes to the hidden page. If the driver reports the vertical blank, the copy starts
/// after it. close() restores the screen's previous content. A console's text cursor stays visible,
/// because hiding it needs privileges; the kernel option vt.global_cursor_default=0 hides it.
class FbdevScreen final : public Screen {
public:
    /// `path`: e.g. "/dev/fb0"; empty: the first usable device. `scaler` must outlive this object.
    FbdevScreen(std::string path, ScreenScaler& scaler);
    ~FbdevScreen() override;

    Presence look(bool thorough) override;
    [[nodiscard]] Size size() const override { return geometry_.size; }
    void show(const Picture& picture) override;
    void releaseGl() override;
    void close() override;
    [[nodiscard]] std::string status() const override;
    [[nodiscard]] std::optional<ScreenPicture> lastShown() const override;

private:
    class Mapping {
    public:
        Mapping(int fd, std::size_t bytes);
        Mapping(const Mapping&) = delete;
        Mapping& operator=(const Mapping&) = delete;
        ~Mapping();
        [[nodiscard]] std::uint8_t* data() const { return data_; }

    private:
        std::uint8_t* data_;
        std::size_t bytes_;
    };

    void open(const std::string& path);
    [[nodiscard]] bool unchanged() const;
    void waitForBlank();
    void panTo(int row);

    std::string wanted_;
    ScreenScaler& scaler_;
    std::string fault_;
    std::string path_;
    OwnedFd fd_;
    fb_var_screeninfo var_{};
    FbGeometry geometry_;
    std::unique_ptr<Mapping> mapping_;
    std::vector<std::uint8_t> before_;
    std::unique_ptr<ScreenReader> reader_;
    int page_ = 0;
    bool pans_ = false;
    bool blankTold_ = true;
    bool shown_ = false;
};

}  // namespace mfar
