#include "hal/device/display_fbdev.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace mfar {
namespace {

constexpr int kDevices = 32;

std::string framebufferFault(const std::string& path) {
    if (errno == EACCES) return path + ": no permission, the user must be in group video";
    return path + ": " + std::strerror(errno);
}

bool readInfo(int fd, fb_var_screeninfo& var, fb_fix_screeninfo& fix) {
    return ioctl(fd, FBIOGET_VSCREENINFO, &var) == 0 && ioctl(fd, FBIOGET_FSCREENINFO, &fix) == 0;
}

PixelChannel channel(const fb_bitfield& field) {
    // Clamped, because narrowing an invalid value to int could make it valid.
    const auto bounded = [](std::uint32_t bits) { return static_cast<int>(std::min(bits, 255U)); };
    return {field.msb_right == 0 ? bounded(field.offset) : -1, bounded(field.length)};
}

PixelLayout checkedLayout(const fb_var_screeninfo& var, const fb_fix_screeninfo& fix) {
    const PixelLayout layout{static_cast<int>(std::min(var.bits_per_pixel, 255U)), channel(var.red),
                             channel(var.green), channel(var.blue), channel(var.transp)};
    if (fix.type != FB_TYPE_PACKED_PIXELS ||
        (fix.visual != FB_VISUAL_TRUECOLOR && fix.visual != FB_VISUAL_DIRECTCOLOR) ||
        var.grayscale != 0 || !layout.valid())
        throw std::runtime_error(
            fmt::format("the pixel format with {} bits per pixel is not supported; expected true "
                        "colour with 16, 24 or 32 bits",
                        var.bits_per_pixel));
    return layout;
}

}  // namespace

FbGeometry checkedGeometry(const fb_var_screeninfo& var, const fb_fix_screeninfo& fix) {
    const PixelLayout layout = checkedLayout(var, fix);
    const auto inside = [](std::uint32_t length) {
        return length >= 1 && length <= std::uint32_t{kMaxScreenSide};
    };
    if (!inside(var.xres) || !inside(var.yres) || var.xoffset > std::uint32_t{kMaxScreenSide} ||
        var.yoffset > std::uint32_t{kMaxScreenSide})
        throw std::runtime_error(
            fmt::format("the driver reports an invalid screen of {}x{} pixels at offset ({}, {})",
                        var.xres, var.yres, var.xoffset, var.yoffset));
    FbGeometry g{{static_cast<int>(var.xres), static_cast<int>(var.yres)},
                 layout,
                 fix.line_length,
                 fix.smem_len,
                 0,
                 0,
                 1};
    const std::size_t rowEnd = (std::size_t{var.xoffset} + var.xres) * layout.bytes();
    const auto holds = [&](std::size_t rows) {
        return rows <= var.yres_virtual && rows * g.stride <= g.bytes;
    };
    // A page can be shown by panning only if its height is a multiple of the pan step.
    if (fix.ypanstep > 0 && var.yres % fix.ypanstep == 0 && holds(std::size_t{2} * var.yres))
        g.pages = 2;
    g.visible = var.yoffset * g.stride + var.xoffset * layout.bytes();
    g.page0 = var.xoffset * layout.bytes();
    if (rowEnd > g.stride || std::size_t{var.xoffset} + var.xres > var.xres_virtual ||
        !holds(std::size_t{var.yoffset} + var.yres))
        throw std::runtime_error(
            fmt::format("a screen of {}x{} pixels at offset ({}, {}) in rows of {} bytes does not "
                        "fit into a framebuffer of {} bytes and {}x{} pixels",
                        var.xres, var.yres, var.xoffset, var.yoffset, fix.line_length, fix.smem_len,
                        var.xres_virtual, var.yres_virtual));
    return g;
}

FbdevScreen::Mapping::Mapping(int fd, std::size_t bytes) : data_(nullptr), bytes_(bytes) {
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (memory == MAP_FAILED)  // NOLINT(performance-no-int-to-ptr): the system's own constant
        throw std::runtime_error(
            fmt::format("the framebuffer cannot be mapped: {}", std::strerror(errno)));
    data_ = static_cast<std::uint8_t*>(memory);
}

FbdevScreen::Mapping::~Mapping() {
    munmap(data_, bytes_);
}

FbdevScreen::FbdevScreen(std::string path, ScreenScaler& scaler)
    : wanted_(std::move(path)), scaler_(scaler) {}

FbdevScreen::~FbdevScreen() {
    close();
}

void FbdevScreen::open(const std::string& path) {
    OwnedFd fd(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    if (!fd) throw std::runtime_error(framebufferFault(path));
    fb_fix_screeninfo fix{};
    if (!readInfo(fd.get(), var_, fix))
        throw std::runtime_error(path + " is not a framebuffer: " + std::strerror(errno));
    try {
        geometry_ = checkedGeometry(var_, fix);
        mapping_ = std::make_unique<Mapping>(fd.get(), geometry_.bytes);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(path + ": " + error.what());
    }
    fd_ = std::move(fd);
    path_ = path;
    // Some drivers report that they can pan, but refuse to.
    pans_ = geometry_.pages == 2 && ioctl(fd_.get(), FBIOPAN_DISPLAY, &var_) == 0;
    page_ = 0;
    blankTold_ = true;
    shown_ = false;
}

bool FbdevScreen::unchanged() const {
    struct stat byName{}, byFd{};
    if (stat(path_.c_str(), &byName) != 0 || fstat(fd_.get(), &byFd) != 0 ||
        byName.st_rdev != byFd.st_rdev || byName.st_ino != byFd.st_ino)
        return false;
    fb_var_screeninfo var{};
    fb_fix_screeninfo fix{};
    if (!readInfo(fd_.get(), var, fix)) return false;
    // The pan offset is not compared, because this object changes it.
    var.yoffset = var_.yoffset;
    try {
        return checkedGeometry(var, fix) == geometry_;
    } catch (const std::runtime_error&) {
        return false;
    }
}

Screen::Presence FbdevScreen::look(bool) {
    if (fd_ && unchanged()) return Presence::Ready;
    close();
    const int last = wanted_.empty() ? kDevices : 1;
    std::string fault;
    for (int i = 0; i < last; ++i) {
        const std::string path = wanted_.empty() ? fmt::format("/dev/fb{}", i) : wanted_;
        if (access(path.c_str(), F_OK) != 0 && wanted_.empty()) continue;
        try {
            open(path);
            return Presence::Ready;
        } catch (const std::runtime_error& error) {
            if (fault.empty()) fault = error.what();
        }
    }
    fault_ = fault.empty() ? "there is no /dev/fb0" : fault;
    return Presence::Absent;
}

void FbdevScreen::waitForBlank() {
    std::uint32_t screen = 0;
    if (blankTold_) blankTold_ = ioctl(fd_.get(), FBIO_WAITFORVSYNC, &screen) == 0;
}

void FbdevScreen::show(const Picture& picture) {
    if (!reader_) reader_ = std::make_unique<ScreenReader>(geometry_.size, scaler_);
    if (!shown_) before_.assign(mapping_->data(), mapping_->data() + geometry_.bytes);
    shown_ = true;
    reader_->begin(picture);
    // After the vertical blank, the last pan has taken effect, so the other page is hidden.
    waitForBlank();
    page_ = 1 - page_;
    const std::size_t page = geometry_.page0 + static_cast<std::size_t>(page_) * geometry_.stride *
                                                   geometry_.size.height;
    std::uint8_t* to = mapping_->data() + (pans_ ? page : geometry_.visible);
    reader_->finish([&](const ImageView& pixels) {
        packPixels(pixels, geometry_.layout, to, geometry_.stride);
    });
    if (pans_) panTo(page_ * geometry_.size.height);
}

void FbdevScreen::panTo(int row) {
    fb_var_screeninfo to = var_;
    to.yoffset = static_cast<std::uint32_t>(row);
    if (ioctl(fd_.get(), FBIOPAN_DISPLAY, &to) != 0)
        throw std::runtime_error(
            fmt::format("{}: panning failed: {}", path_, std::strerror(errno)));
}

void FbdevScreen::releaseGl() {
    reader_.reset();
}

void FbdevScreen::close() {
    if (mapping_ && shown_) {
        std::copy(before_.begin(), before_.end(), mapping_->data());
        if (pans_) ioctl(fd_.get(), FBIOPAN_DISPLAY, &var_);
    }
    reader_.reset();
    mapping_.reset();
    fd_ = OwnedFd();
    shown_ = false;
}

std::string FbdevScreen::status() const {
    if (!fd_) return "fbdev: " + (fault_.empty() ? "not in use" : fault_);
    return fmt::format("fbdev:{}, {}x{}, {} bits{}", path_, geometry_.size.width,
                       geometry_.size.height, geometry_.layout.bits, pans_ ? ", two pages" : "");
}

std::optional<ScreenPicture> FbdevScreen::lastShown() const {
    if (!shown_ || !reader_) return std::nullopt;
    return reader_->last();
}

}  // namespace mfar
