#include "hal/device/display_fbdev.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

namespace mfar {
namespace {

struct Info {
    fb_var_screeninfo var{};
    fb_fix_screeninfo fix{};
};

// A valid description: 800x480, 16 bits per pixel, rows of 1664 bytes, memory for two screens.
Info good() {
    Info i;
    i.var.xres = i.var.xres_virtual = 800;
    i.var.yres = 480;
    i.var.yres_virtual = 960;
    i.var.bits_per_pixel = 16;
    i.var.red = {11, 5, 0};
    i.var.green = {5, 6, 0};
    i.var.blue = {0, 5, 0};
    i.fix.type = FB_TYPE_PACKED_PIXELS;
    i.fix.visual = FB_VISUAL_TRUECOLOR;
    i.fix.line_length = 1664;
    i.fix.smem_len = 1664 * 960;
    i.fix.ypanstep = 1;
    return i;
}

FbGeometry geometry(const std::function<void(Info&)>& change = [](Info&) {}) {
    Info i = good();
    change(i);
    return checkedGeometry(i.var, i.fix);
}

TEST(FbGeometry, UsesTheGeometryThatTheDriverReports) {
    const FbGeometry g = geometry();
    EXPECT_EQ(g.size, (Size{800, 480}));
    EXPECT_EQ(g.layout, (PixelLayout{16, {11, 5}, {5, 6}, {0, 5}, {0, 0}}));
    EXPECT_EQ(g.stride, 1664U);
    EXPECT_EQ(g.bytes, 1664U * 960);
    EXPECT_EQ(g.visible, 0U);
    EXPECT_EQ(g.pages, 2);
}

TEST(FbGeometry, VisiblePartMayLieAnywhereInTheMemory) {
    const FbGeometry g = geometry([](Info& i) {
        i.var.xres = 700;
        i.var.xoffset = 100;
        i.var.yoffset = 480;
    });
    EXPECT_EQ(g.visible, 480U * 1664 + 200);
    EXPECT_EQ(g.page0, 200U);
}

TEST(FbGeometry, PansOnlyIfDriverAndMemoryAllowIt) {
    EXPECT_EQ(geometry([](Info& i) { i.fix.ypanstep = 0; }).pages, 1);
    EXPECT_EQ(geometry([](Info& i) { i.fix.ypanstep = 7; }).pages, 1);
    EXPECT_EQ(geometry([](Info& i) { i.var.yres_virtual = 959; }).pages, 1);
    EXPECT_EQ(geometry([](Info& i) { i.fix.smem_len -= 1; }).pages, 1);
}

TEST(FbGeometry, ImpossibleGeometryIsRefused) {
    const std::vector<std::function<void(Info&)>> lies{
        [](Info& i) { i.var.xres = 0; },
        [](Info& i) { i.var.yres = 0; },
        [](Info& i) { i.var.xres = 20000; },
        [](Info& i) { i.var.xres = i.var.xres_virtual = 833; },
        [](Info& i) { i.var.xoffset = 1; },
        [](Info& i) { i.var.xoffset = 0xffffffff; },
        [](Info& i) { i.var.yoffset = 481; },
        [](Info& i) { i.var.yoffset = 0xfffffe20; },  // 0xfffffe20 + 480 overflows to 0
        [](Info& i) { i.var.yres_virtual = 479; },
        [](Info& i) { i.fix.smem_len = 1664 * 480 - 1; },
        [](Info& i) { i.fix.smem_len = 0; },
        [](Info& i) { i.fix.line_length = 1599; },
        [](Info& i) { i.fix.line_length = 0; },
        [](Info& i) { i.fix.line_length = 0xffffffff; },
    };
    for (std::size_t i = 0; i < lies.size(); ++i)
        EXPECT_THROW((void)geometry(lies[i]), std::runtime_error)
            << "accepted impossible geometry " << i;
}

TEST(FbGeometry, OnlyPackedTrueColourIsAccepted) {
    const std::vector<std::function<void(Info&)>> others{
        [](Info& i) { i.fix.type = FB_TYPE_PLANES; },
        [](Info& i) { i.fix.visual = FB_VISUAL_PSEUDOCOLOR; },
        [](Info& i) { i.var.bits_per_pixel = 8; },
        [](Info& i) { i.var.bits_per_pixel = 0x80000010; },
        [](Info& i) { i.var.grayscale = 1; },
        [](Info& i) { i.var.red.offset = 12; },
        [](Info& i) { i.var.red.offset = 0xffffffff; },
        [](Info& i) { i.var.green.length = 0; },
        [](Info& i) { i.var.blue.msb_right = 1; },
    };
    for (std::size_t i = 0; i < others.size(); ++i)
        EXPECT_THROW((void)geometry(others[i]), std::runtime_error)
            << "accepted invalid layout " << i;
}

}  // namespace
}  // namespace mfar
