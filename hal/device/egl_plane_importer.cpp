#include "hal/device/egl_plane_importer.h"

#include "base/gl/gl.h"
#include "hal/device/egl_extensions.h"

#include <EGL/eglext.h>
#include <GLES3/gl31.h>

#include <GLES2/gl2ext.h>
#include <array>
#include <drm_fourcc.h>
#include <stdexcept>
#include <unordered_map>

namespace mfar {
namespace {

EGLint fourccOf(int channels) {
    switch (channels) {
    case 1: return static_cast<EGLint>(DRM_FORMAT_R8);
    case 2: return static_cast<EGLint>(DRM_FORMAT_GR88);
    default: return static_cast<EGLint>(DRM_FORMAT_ABGR8888);
    }
}

class EglPlaneImporter final : public PlaneImporter {
public:
    explicit EglPlaneImporter(EGLDisplay display) : display_(display) {
        create_ = eglProc<PFNEGLCREATEIMAGEKHRPROC>("eglCreateImageKHR");
        destroy_ = eglProc<PFNEGLDESTROYIMAGEKHRPROC>("eglDestroyImageKHR");
        target_ = eglProc<PFNGLEGLIMAGETARGETTEXTURE2DOESPROC>("glEGLImageTargetTexture2DOES");
    }
    EglPlaneImporter(const EglPlaneImporter&) = delete;
    EglPlaneImporter& operator=(const EglPlaneImporter&) = delete;
    ~EglPlaneImporter() override {
        for (const auto& [texture, image] : images_)
            destroy_(display_, image);
    }
    [[nodiscard]] bool isComplete() const {
        return create_ != nullptr && destroy_ != nullptr && target_ != nullptr;
    }

    unsigned import(const SharedPlane& plane) override {
        const std::array<EGLint, 13> attributes{EGL_WIDTH,
                                                plane.size.width,
                                                EGL_HEIGHT,
                                                plane.size.height,
                                                EGL_LINUX_DRM_FOURCC_EXT,
                                                fourccOf(plane.channels),
                                                EGL_DMA_BUF_PLANE0_FD_EXT,
                                                plane.fd,
                                                EGL_DMA_BUF_PLANE0_OFFSET_EXT,
                                                static_cast<EGLint>(plane.offset),
                                                EGL_DMA_BUF_PLANE0_PITCH_EXT,
                                                static_cast<EGLint>(plane.stride),
                                                EGL_NONE};
        const EGLImageKHR image =
            create_(display_, EGL_NO_CONTEXT, EGL_LINUX_DMA_BUF_EXT, nullptr, attributes.data());
        if (image == EGL_NO_IMAGE_KHR)
            throw std::runtime_error("the GPU's driver cannot import the camera's buffer");
        (void)gpu::takeError();
        GLuint texture = 0;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        target_(GL_TEXTURE_2D, image);
        images_[texture] = image;
        if (glGetError() == GL_NO_ERROR) return texture;
        forget(texture);
        throw std::runtime_error("the GPU's driver cannot use the camera's buffer as a texture");
    }
    void forget(unsigned texture) override {
        glDeleteTextures(1, &texture);
        const auto found = images_.find(texture);
        if (found == images_.end()) return;
        destroy_(display_, found->second);
        images_.erase(found);
    }

private:
    EGLDisplay display_;
    PFNEGLCREATEIMAGEKHRPROC create_ = nullptr;
    PFNEGLDESTROYIMAGEKHRPROC destroy_ = nullptr;
    PFNGLEGLIMAGETARGETTEXTURE2DOESPROC target_ = nullptr;
    std::unordered_map<unsigned, EGLImageKHR> images_;
};

}  // namespace

std::unique_ptr<PlaneImporter> createPlaneImporter(EGLDisplay display) {
    if (!hasExtension(eglQueryString(display, EGL_EXTENSIONS), "EGL_EXT_image_dma_buf_import"))
        return nullptr;
    if (!hasExtension(reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS)),
                      "GL_OES_EGL_image"))
        return nullptr;
    auto importer = std::make_unique<EglPlaneImporter>(display);
    if (!importer->isComplete()) return nullptr;
    return importer;
}

}  // namespace mfar
