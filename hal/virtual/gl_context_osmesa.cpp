#include "base/gl/gl.h"
#include "hal/gl_context.h"

#include <GL/osmesa.h>
#include <GLES3/gl31.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

class OsMesaContext final : public GlContext {
public:
    OsMesaContext() {
        const std::array<int, 9> wanted{OSMESA_FORMAT,
                                        OSMESA_RGBA,
                                        OSMESA_PROFILE,
                                        OSMESA_CORE_PROFILE,
                                        OSMESA_CONTEXT_MAJOR_VERSION,
                                        4,
                                        OSMESA_CONTEXT_MINOR_VERSION,
                                        5,
                                        0};
        context_ = OSMesaCreateContextAttribs(wanted.data(), nullptr);
        if (context_ == nullptr)
            throw std::runtime_error(
                "OSMesa: an OpenGL 4.5 context cannot be created; Mesa 20.2 or later is needed");
        makeCurrent();
        description_ = std::string("OSMesa: ") +
                       reinterpret_cast<const char*>(glGetString(GL_RENDERER)) + ", OpenGL " +
                       reinterpret_cast<const char*>(glGetString(GL_VERSION)) + ", software";
        // Makes OpenGL encode values as sRGB when it draws into sRGB textures, as OpenGL ES always
        // does.
        constexpr GLenum kFramebufferSrgb = 0x8DB9;
        glEnable(kFramebufferSrgb);
        glGenVertexArrays(1, &vertexArray_);
        glBindVertexArray(vertexArray_);
    }
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;
    ~OsMesaContext() override { OSMesaDestroyContext(context_); }

    void makeCurrent() override {
        // OSMesa needs a buffer for the window. It stays unused, because all passes draw into
        // framebuffer objects.
        if (OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, 4, 4) != GL_TRUE)
            throw std::runtime_error("OSMesa: the context cannot be made current");
    }
    void release() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
    Proc getProcAddress(const char* name) const override {
        return reinterpret_cast<Proc>(OSMesaGetProcAddress(name));
    }
    std::optional<std::string> takeFault() override {
        const GLenum error = gpu::takeError();
        if (error == GL_NO_ERROR) return std::nullopt;
        return "OpenGL reports error " + gpu::errorCode(error);
    }
    bool isSoftware() const override { return true; }
    std::string description() const override { return description_; }

private:
    OSMesaContext context_ = nullptr;
    std::array<std::uint8_t, 64> window_{};
    GLuint vertexArray_ = 0;
    std::string description_;
};

}  // namespace

std::unique_ptr<GlContext> createGlContext(GlDevice /*software*/) {
    return std::make_unique<OsMesaContext>();
}

}  // namespace mfar
