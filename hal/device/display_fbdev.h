#pragma once

#include "base/owned_fd.h"
#include "hal/device/display_pixels.h"
#include "hal/device/display_screen.h"
#include "hal/device/display_spec.h"

#include <linux/fb.h>

#include <memory>
#include <vector>

namespace mfar {

/// A framebuffer device's memory, checked: every row of every page lies inside it.
struct FbGeometry {
    Size size;
    PixelLayout layout;
    std::size_t stride = 0;   ///< bytes from one row to the next
    std::size_t bytes = 0;    ///< of the whole memory
    std::size_t visible = 0;  ///< bytes from the memory's begin to the first visible pixel
    std::size_t page0 = 0;    ///< the same once panned to the top
    int pages = 1;            ///< 2: there is a second screen below the first
    bool operator==(const FbGeometry&) const = default;
};

/// What a driver says of its memory. Throws std::runtime_error for a format that is not 16, 24 or
/// 32 bit true colour and for numbers that contradict each other.
[[nodiscard]] FbGeometry checkedGeometry(const fb_var_screeninfo& var,
                                         const fb_fix_screeninfo& fix);

/// A Linux framebuffer, /dev/fbN. The picture is scaled where it is and copied by the CPU, into the
/// hidden page where the driver pans, after the vertical blank where the driver tells it. What was
/// on the screen is put back at close(). The text cursor of a console on the same screen is not
/// hidden: that takes rights this program does without (kernel option vt.global_cursor_default=0).
class FbdevScreen final : public Screen {
public:
    /// `path`: "/dev/fb0"; empty: the first that can be used. `scaler` must
    /// outlive it.
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
    std::string path_;  // of the open device
    OwnedFd fd_;
    fb_var_screeninfo var_{};
    FbGeometry geometry_;
    std::unique_ptr<Mapping> mapping_;
    std::vector<std::uint8_t> before_;  // the memory as it was found
    std::unique_ptr<ScreenReader> reader_;
    int page_ = 0;
    bool pans_ = false;
    bool blankTold_ = true;
    bool shown_ = false;
};

}  // namespace mfar
