#include "base/gl/fence.h"
#include "hal/device/display_buffers.h"
#include "hal/device/egl_extensions.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>

#include <GLES2/gl2ext.h>
#include <array>
#include <drm_fourcc.h>
#include <gbm.h>
#include <stdexcept>
#include <string_view>

namespace mfar {
namespace {

using GbmDevice = std::unique_ptr<gbm_device, FreedBy<gbm_device_destroy>>;
using GbmBuffer = std::unique_ptr<gbm_bo, FreedBy<gbm_bo_destroy>>;

// GBM buffers are not used with a software renderer, because it draws fastest into its own memory.
// Besides, Mesa's software renderer crashes if it cannot map an imported buffer.
bool isSoftware(std::string_view renderer) {
    return renderer.find("llvmpipe") != renderer.npos ||
           renderer.find("softpipe") != renderer.npos || renderer.find("swrast") != renderer.npos;
}

std::string_view glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

const char* eglExtensions(EGLDisplay display) {
    return display != EGL_NO_DISPLAY ? eglQueryString(display, EGL_EXTENSIONS) : nullptr;
}

struct Importer {
    EGLDisplay display = eglGetCurrentDisplay();
    bool modifiers = false;
    PFNEGLCREATEIMAGEKHRPROC createImage = nullptr;
    PFNEGLDESTROYIMAGEKHRPROC destroyImage = nullptr;
    PFNGLEGLIMAGETARGETRENDERBUFFERSTORAGEOESPROC imageStorage = nullptr;

    Importer() {
        if (display == EGL_NO_DISPLAY) throw std::runtime_error("there is no GL context");
        const char* egl = eglExtensions(display);
        if (isSoftware(glText(GL_RENDERER)))
            throw std::runtime_error("OpenGL ES runs in software, not on a GPU");
        if (!hasExtension(egl, "EGL_EXT_image_dma_buf_import") ||
            !hasExtension(glText(GL_EXTENSIONS).data(), "GL_OES_EGL_image"))
            throw std::runtime_error("the GPU's driver cannot import buffers");
        modifiers = hasExtension(egl, "EGL_EXT_image_dma_buf_import_modifiers");
        load(createImage, "eglCreateImageKHR");
        load(destroyImage, "eglDestroyImageKHR");
        load(imageStorage, "glEGLImageTargetRenderbufferStorageOES");
    }

    template <class F>
    static void load(F& function, const char* name) {
        function = eglProc<F>(name);
        if (function == nullptr) throw std::runtime_error(std::string("EGL lacks ") + name);
    }
};

/// Inserts fences into the GL commands and exports them as file descriptors. The constructor throws
/// if EGL does not support that.
class NativeFences {
public:
    explicit NativeFences(EGLDisplay display) : display_(display) {
        if (!hasExtension(eglExtensions(display), "EGL_ANDROID_native_fence_sync"))
            throw std::runtime_error("the GPU's driver cannot export fences");
        Importer::load(create_, "eglCreateSyncKHR");
        Importer::load(destroy_, "eglDestroySyncKHR");
        Importer::load(dup_, "eglDupNativeFenceFDANDROID");
    }
    [[nodiscard]] OwnedFd insert() const {
        const EGLSyncKHR sync = create_(display_, EGL_SYNC_NATIVE_FENCE_ANDROID, nullptr);
        if (sync == EGL_NO_SYNC_KHR) throw std::runtime_error("EGL cannot create a fence");
        glFlush();  // a fence has a file descriptor only after a flush
        OwnedFd fd(dup_(display_, sync));
        destroy_(display_, sync);
        if (!fd) throw std::runtime_error("EGL cannot export a fence");
        return fd;
    }

private:
    EGLDisplay display_;
    PFNEGLCREATESYNCKHRPROC create_ = nullptr;
    PFNEGLDESTROYSYNCKHRPROC destroy_ = nullptr;
    PFNEGLDUPNATIVEFENCEFDANDROIDPROC dup_ = nullptr;
};

/// Allocates a buffer for the screen. Its layout is linear, because the GPU and the card that
/// drives the screen may be different devices, and both support this layout.
GbmBuffer allocate(gbm_device* device, Size size) {
    GbmBuffer buffer(gbm_bo_create(device, static_cast<std::uint32_t>(size.width),
                                   static_cast<std::uint32_t>(size.height), GBM_FORMAT_XRGB8888,
                                   GBM_BO_USE_SCANOUT | GBM_BO_USE_RENDERING | GBM_BO_USE_LINEAR));
    if (!buffer) throw std::runtime_error("GBM cannot allocate a buffer for the screen");
    return buffer;
}

class GbmTarget {
public:
    GbmTarget(const Importer& importer, gbm_device* device, int fd, Size size)
        : importer_(importer), buffer_(allocate(device, size)),
          scanout_(fd, size, gbm_bo_get_handle(buffer_.get()).u32,
                   gbm_bo_get_stride(buffer_.get())),
          image_(import(size)) {
        if (image_ == EGL_NO_IMAGE_KHR)
            throw std::runtime_error("the GPU's driver cannot import the screen's buffer");
        const KeptTarget kept;
        glGenRenderbuffers(1, &renderbuffer_);
        glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer_);
        importer_.imageStorage(GL_RENDERBUFFER, image_);
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                  renderbuffer_);
        const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
        glBindRenderbuffer(GL_RENDERBUFFER, 0);
        if (complete && glGetError() == GL_NO_ERROR) return;
        release();
        throw std::runtime_error("the GPU cannot draw into the screen's buffer");
    }
    GbmTarget(const GbmTarget&) = delete;
    GbmTarget& operator=(const GbmTarget&) = delete;
    ~GbmTarget() { release(); }

    [[nodiscard]] GLuint framebuffer() const { return framebuffer_; }
    [[nodiscard]] std::uint32_t scanout() const { return scanout_.id(); }
    void release() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteRenderbuffers(1, &renderbuffer_);
        framebuffer_ = renderbuffer_ = 0;
        if (image_ != EGL_NO_IMAGE_KHR) importer_.destroyImage(importer_.display, image_);
        image_ = EGL_NO_IMAGE_KHR;
    }

private:
    EGLImageKHR import(Size size) {
        const OwnedFd dmaBuf(gbm_bo_get_fd(buffer_.get()));
        std::array<EGLint, 17> attributes{
            EGL_WIDTH, size.width, EGL_HEIGHT, size.height, EGL_LINUX_DRM_FOURCC_EXT,
            static_cast<EGLint>(DRM_FORMAT_XRGB8888), EGL_DMA_BUF_PLANE0_FD_EXT, dmaBuf.get(),
            EGL_DMA_BUF_PLANE0_OFFSET_EXT, 0, EGL_DMA_BUF_PLANE0_PITCH_EXT,
            static_cast<EGLint>(gbm_bo_get_stride(buffer_.get())),
            // If EGL does not support modifiers, EGL_NONE ends the attribute list here.
            importer_.modifiers ? EGL_DMA_BUF_PLANE0_MODIFIER_LO_EXT : EGL_NONE,
            static_cast<EGLint>(DRM_FORMAT_MOD_LINEAR & 0xffffffffU),
            EGL_DMA_BUF_PLANE0_MODIFIER_HI_EXT, static_cast<EGLint>(DRM_FORMAT_MOD_LINEAR >> 32),
            EGL_NONE};
        return importer_.createImage(importer_.display, EGL_NO_CONTEXT, EGL_LINUX_DMA_BUF_EXT,
                                     nullptr, attributes.data());
    }
    const Importer& importer_;
    GbmBuffer buffer_;
    DrmFramebuffer scanout_;
    EGLImageKHR image_;
    GLuint renderbuffer_ = 0, framebuffer_ = 0;
};

class GbmBuffers final : public ScanoutBuffers {
public:
    GbmBuffers(int fd, Size size, bool fences, ScreenScaler& scaler)
        : size_(size), scaler_(scaler), device_(openDevice(fd)),
          targets_{{{importer_, device_.get(), fd, size},
                    {importer_, device_.get(), fd, size},
                    {importer_, device_.get(), fd, size}}} {
        if (fences) fences_.emplace(importer_.display);
    }

    // One of the three buffers is on the screen, one may wait for the vertical blank, and the third
    // is free.
    void begin(const Picture& picture) override {
        const KeptTarget kept;
        current_ = (current_ + 1) % targets_.size();
        scaler_.draw(picture, targets_[current_].framebuffer(), size_, ScreenScaler::Order::Rgba);
        if (fences_) fence_ = fences_->insert();
    }
    Ready complete() override {
        if (!fences_ && !gpu::finishWithin())
            throw gpu::GlError("the GPU does not finish the picture");
        return {targets_[current_].scanout(), std::move(fence_)};
    }
    void releaseGl() override {
        for (GbmTarget& target : targets_)
            target.release();
    }
    [[nodiscard]] ScreenPicture last() const override {
        const KeptTarget kept;
        return readFramebuffer(targets_[current_].framebuffer(), size_, PixelFormat::Rgba8);
    }

private:
    static GbmDevice openDevice(int fd) {
        GbmDevice device(gbm_create_device(fd));
        if (!device) throw std::runtime_error("GBM does not support the display's driver");
        return device;
    }

    Size size_;
    Importer importer_;
    std::optional<NativeFences> fences_;
    ScreenScaler& scaler_;
    GbmDevice device_;
    std::array<GbmTarget, 3> targets_;
    std::size_t current_ = 0;
    OwnedFd fence_;
};

}  // namespace

std::unique_ptr<ScanoutBuffers> makeGbmBuffers(const DrmCard& card, Size size, bool fences,
                                               ScreenScaler& scaler) {
    return std::make_unique<GbmBuffers>(card.fd(), size, fences, scaler);
}

}  // namespace mfar
