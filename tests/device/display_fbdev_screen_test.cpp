#include "base/rows.h"
#include "hal/device/display_fbdev.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace mfar {
namespace {

constexpr int kWidth = 64, kHeight = 48, kRow = 4 * kWidth;

/// A simulated framebuffer driver with 32 bits per pixel and memory for two screens. The memory is
/// a file, so that opening and mapping are real.
struct PretendedFramebuffer {
    bool canPan = true;
    std::uint32_t shownRow = 0;
    int blanks = 0;  ///< number of calls that wait for the vertical blank

    int answer(unsigned long request, void* argument) {
        switch (request) {
        case FBIOGET_VSCREENINFO: describe(*static_cast<fb_var_screeninfo*>(argument)); return 0;
        case FBIOGET_FSCREENINFO: describe(*static_cast<fb_fix_screeninfo*>(argument)); return 0;
        case FBIOPAN_DISPLAY:
            if (!canPan) return EINVAL;
            shownRow = static_cast<fb_var_screeninfo*>(argument)->yoffset;
            return 0;
        case FBIO_WAITFORVSYNC: ++blanks; return ENOTTY;
        default: return ENOTTY;
        }
    }

private:
    void describe(fb_var_screeninfo& out) const {
        out = {};
        out.xres = out.xres_virtual = kWidth;
        out.yres = kHeight;
        out.yres_virtual = 2 * kHeight;
        out.yoffset = shownRow;
        out.bits_per_pixel = 32;
        out.red = {16, 8, 0};
        out.green = {8, 8, 0};
        out.blue = {0, 8, 0};
    }
    static void describe(fb_fix_screeninfo& out) {
        out = {};
        out.type = FB_TYPE_PACKED_PIXELS;
        out.visual = FB_VISUAL_TRUECOLOR;
        out.line_length = kRow;
        out.smem_len = 2 * kRow * kHeight;
        out.ypanstep = 1;
    }
};

PretendedFramebuffer* framebuffer = nullptr;

class FbdevScreenTest : public testing::Test {
protected:
    FbdevScreenTest() { framebuffer = &driver_; }
    ~FbdevScreenTest() override { framebuffer = nullptr; }

    void SetUp() override {
        test::writeFile(file_, console_);
        ASSERT_EQ(screen_.look(true), Screen::Presence::Ready) << screen_.status();
        ASSERT_EQ(screen_.size(), (Size{kWidth, kHeight}));
    }

    void show(std::uint32_t rgba) {
        AlignedRows<std::uint32_t> rows({kWidth, kHeight});
        for (int y = 0; y < kHeight; ++y)
            std::fill_n(rows[y], kWidth, rgba);
        screen_.show(Picture(rows.rows()));
    }
    /// Returns the colour (XRGB8888) of the page that begins at this row. Returns nothing if its
    /// pixels differ.
    [[nodiscard]] std::optional<std::uint32_t> page(int row) const {
        std::vector<std::uint32_t> pixels(std::size_t{kWidth} * kHeight);
        std::ifstream in(file_, std::ios::binary);
        in.seekg(std::streamoff{row} * kRow);
        in.read(reinterpret_cast<char*>(pixels.data()),
                static_cast<std::streamsize>(4 * pixels.size()));
        const bool isEven = std::ranges::all_of(
            pixels, [&](std::uint32_t p) { return ((p ^ pixels[0]) & 0xffffffU) == 0; });
        return isEven ? std::optional(pixels[0] & 0xffffffU) : std::nullopt;
    }
    [[nodiscard]] std::string content() const {
        std::ifstream in(file_, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    const std::string console_ = std::string(2UL * kRow * kHeight, '\7');
    const std::uint32_t consoleColour_ = 0x070707;
    test::TempFolder folder_;
    std::string file_ = (folder_ / "fb0").string();
    PretendedFramebuffer driver_;
    ScreenScaler scaler_;
    FbdevScreen screen_{file_, scaler_};
};

TEST_F(FbdevScreenTest, EachPictureIsWrittenToTheHiddenPageAndThenShown) {
    show(0xff302010U);
    EXPECT_EQ(page(0), consoleColour_) << "the visible page must not change";
    EXPECT_EQ(page(kHeight), 0x102030U);
    EXPECT_EQ(driver_.shownRow, kHeight);
    show(0xff605040U);
    EXPECT_EQ(page(0), 0x405060U);
    EXPECT_EQ(page(kHeight), 0x102030U);
    EXPECT_EQ(driver_.shownRow, 0U);
    EXPECT_EQ(driver_.blanks, 1) << "a driver without vertical blank must be asked only once";
}

TEST_F(FbdevScreenTest, CloseRestoresTheConsole) {
    show(0xff302010U);
    screen_.close();
    EXPECT_EQ(content(), console_);
    EXPECT_EQ(driver_.shownRow, 0U);
}

TEST_F(FbdevScreenTest, ADriverThatRefusesToPanShowsPicturesOnItsVisiblePage) {
    screen_.close();
    driver_.canPan = false;
    ASSERT_EQ(screen_.look(true), Screen::Presence::Ready) << screen_.status();
    for (const std::uint32_t rgba : {0xff302010U, 0xff605040U}) {
        show(rgba);
        EXPECT_EQ(page(0), rgba == 0xff302010U ? 0x102030U : 0x405060U);
        EXPECT_EQ(page(kHeight), consoleColour_);
    }
    screen_.close();
    EXPECT_EQ(content(), console_);
}

}  // namespace
}  // namespace mfar

// The program's calls of ioctl() arrive here instead of in the C library.
extern "C" int ioctl(int fd, unsigned long request, ...) noexcept {
    std::va_list arguments;
    va_start(arguments, request);
    void* const argument = va_arg(arguments, void*);
    va_end(arguments);
    const bool isForFramebuffer = (request >> 8U & 0xffU) == 'F';
    if (mfar::framebuffer == nullptr || !isForFramebuffer)
        return static_cast<int>(syscall(SYS_ioctl, fd, request, argument));
    const int error = mfar::framebuffer->answer(request, argument);
    if (error == 0) return 0;
    errno = error;
    return -1;
}
