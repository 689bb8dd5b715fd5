#include "base/gl/gl.h"

#include "hal/device/egl_extensions.h"
#include "hal/device/egl_plane_importer.h"
#include "hal/device/gl_libraries.h"
#include "hal/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mfar {
namespace {

std::string text(GLenum name) {
    const GLubyte* s = glGetString(name);
    return s != nullptr ? reinterpret_cast<const char*>(s) : "unknown";
}

EGLDisplay initialised(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
        return EGL_NO_DISPLAY;
    return display;
}

struct OpenedDisplay {
    EGLDisplay display;
    const char* how;
};

// GL_KHR_robustness and GL_EXT_robustness define the same values.
constexpr GLenum kGuiltyReset = 0x8253, kInnocentReset = 0x8254;
using ResetStatus = GLenum(GL_APIENTRYP)();

ResetStatus resetStatusOf(std::string_view version, const char* glExtensions) {
    if (version.starts_with("OpenGL ES 3.2"))
        return eglProc<ResetStatus>("glGetGraphicsResetStatus");
    if (hasExtension(glExtensions, "GL_KHR_robustness"))
        return eglProc<ResetStatus>("glGetGraphicsResetStatusKHR");
    if (hasExtension(glExtensions, "GL_EXT_robustness"))
        return eglProc<ResetStatus>("glGetGraphicsResetStatusEXT");
    return nullptr;
}

// Returns the message for drivers without OpenGL ES 3.1, such as lima, vc4 and etnaviv.
std::string tooOld(EGLDisplay display) {
    const char* name = nullptr;
    if (hasExtension(eglQueryString(display, EGL_EXTENSIONS), "EGL_MESA_query_driver"))
        if (const auto ask = eglProc<const char* (*)(EGLDisplay)>("eglGetDisplayDriverName"))
            name = ask(display);
    return "EGL: the GPU's driver" + (name != nullptr ? " " + std::string(name) : "") +
           " has no OpenGL ES 3.1; use the SIMD engine (engine.use = \"simd\")";
}

// The context reports resets of the GPU if the driver supports that. The EGL extension and EGL 1.5
// have different attributes for this, and some drivers accept only one of them.
EGLContext createContext(EGLDisplay display, EGLConfig config) {
    const auto create = [&](EGLint attribute, EGLint value) {
        const std::array<EGLint, 7> wanted{
            EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, attribute, value, EGL_NONE};
        return eglCreateContext(display, config, EGL_NO_CONTEXT, wanted.data());
    };
    EGLContext context = EGL_NO_CONTEXT;
    if (hasExtension(eglQueryString(display, EGL_EXTENSIONS), "EGL_EXT_create_context_robustness"))
        context = create(EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
                         EGL_LOSE_CONTEXT_ON_RESET_EXT);
    const char* version = eglQueryString(display, EGL_VERSION);
    if (context == EGL_NO_CONTEXT && version != nullptr && std::string_view(version) >= "1.5")
        context = create(EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET);
    return context != EGL_NO_CONTEXT ? context : create(EGL_NONE, EGL_NONE);
}

// Opens the first EGL device that is a GPU or, if `software` is set, the first that is a software
// renderer (EGL_MESA_device_software). If no such device can be opened, opens the surfaceless
// platform, which may use either.
OpenedDisplay openDisplay(bool software) {
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto platformDisplay =
        eglProc<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (platformDisplay == nullptr)
        throw std::runtime_error(
            "EGL: EGL_EXT_platform_base is missing; a newer EGL library is needed");
    if (hasExtension(client, "EGL_EXT_platform_device")) {
        const auto queryDevices = eglProc<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
        const auto queryString = eglProc<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (queryDevices != nullptr && queryString != nullptr)
            queryDevices(devices.size(), devices.data(), &count);
        for (EGLint i = 0; i < count; ++i) {
            if (hasExtension(queryString(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software") !=
                software)
                continue;
            const EGLDisplay display =
                initialised(platformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
            if (display != EGL_NO_DISPLAY) return {display, "EGL device"};
        }
    }
    if (hasExtension(client, "EGL_MESA_platform_surfaceless")) {
        const EGLDisplay display = initialised(
            platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
        if (display != EGL_NO_DISPLAY) return {display, "EGL surfaceless"};
    }
    throw std::runtime_error(
        "EGL: neither a GPU nor the surfaceless platform can be opened; is libgl1-mesa-dri "
        "installed, and may this user read and write /dev/dri/renderD*?");
}

bool isSoftwareWanted() {
    const char* value = std::getenv("MFAR_GL_DEVICE");
    if (value == nullptr || *value == '\0') return false;
    if (std::strcmp(value, "software") == 0) return true;
    throw std::runtime_error("the environment variable MFAR_GL_DEVICE is \"" + std::string(value) +
                             "\", but its only valid value is \"software\"");
}

OpenedDisplay sharedDisplay(GlDevice device) {
    static std::mutex mutex;
    static std::array<OpenedDisplay, 2> all{{{EGL_NO_DISPLAY, ""}, {EGL_NO_DISPLAY, ""}}};
    const std::lock_guard lock(mutex);
    [[maybe_unused]] static const bool areLoaded = (loadGlLibraries(), true);
    const bool software = isSoftwareWanted() || device == GlDevice::Software;
    OpenedDisplay& opened = all[software ? 1 : 0];
    if (opened.display == EGL_NO_DISPLAY) opened = openDisplay(software);
    return opened;
}

class EglContext final : public GlContext {
public:
    explicit EglContext(GlDevice device) {
        const OpenedDisplay opened = sharedDisplay(device);
        display_ = opened.display;
        eglBindAPI(EGL_OPENGL_ES_API);
        const std::array<EGLint, 7> configWanted{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE,
                                                 EGL_OPENGL_ES3_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (eglChooseConfig(display_, configWanted.data(), &config, 1, &count) != EGL_TRUE ||
            count == 0)
            throw std::runtime_error(tooOld(display_));
        context_ = createContext(display_, config);
        if (context_ == EGL_NO_CONTEXT) throw std::runtime_error(tooOld(display_));
        makeCurrent();
        resetStatus_ = resetStatusOf(text(GL_VERSION), text(GL_EXTENSIONS).c_str());
        const std::string renderer = text(GL_RENDERER);
        software_ = renderer.find("llvmpipe") != renderer.npos ||
                    renderer.find("softpipe") != renderer.npos;
        description_ = std::string(opened.how) + ": " + renderer + ", " + text(GL_VERSION) +
                       (software_ ? ", software" : ", hardware");
        if (!software_) importer_ = createPlaneImporter(display_);
        // OpenGL ES 3.1 refuses indirect draws if no vertex array object is bound.
        glGenVertexArrays(1, &vertexArray_);
        glBindVertexArray(vertexArray_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext() override {
        if (eglGetCurrentContext() == context_)
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
    }

    void makeCurrent() override {
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            throw std::runtime_error("EGL: the context cannot be made current without a surface");
    }
    void release() override {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    Proc getProcAddress(const char* name) const override { return eglGetProcAddress(name); }
    PlaneImporter* planeImporter() override { return importer_.get(); }
    std::optional<std::string> takeFault() override {
        const GLenum status = resetStatus_ != nullptr ? resetStatus_() : GL_NO_ERROR;
        if (status == kGuiltyReset) return "the GPU was reset because work of this program hung";
        if (status == kInnocentReset)
            return "the GPU was reset because work of another program hung";
        if (status != GL_NO_ERROR) return "the GPU was reset";
        const GLenum error = gpu::takeError();
        if (error == gpu::kContextLost) return "the OpenGL ES context is lost";
        if (error != GL_NO_ERROR) return "OpenGL ES reports error " + gpu::errorCode(error);
        return std::nullopt;
    }
    bool isSoftware() const override { return software_; }
    std::string description() const override { return description_; }

private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    GLuint vertexArray_ = 0;
    bool software_ = false;
    ResetStatus resetStatus_ = nullptr;
    std::unique_ptr<PlaneImporter> importer_;
    std::string description_;
};

}  // namespace

std::unique_ptr<GlContext> createGlContext(GlDevice device) {
    return std::make_unique<EglContext>(device);
}

}  // namespace mfar
