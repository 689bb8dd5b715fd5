#pragma once

#include "hal/plane_importer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// An OpenGL ES 3.1 context without a window. Belongs to the thread that made it current. EGL or
/// OSMesa is chosen at link time: both define createGlContext().
class GlContext {
public:
    using Proc = void (*)();

    virtual ~GlContext() = default;

    virtual void makeCurrent() = 0;
    /// Releases it from this thread, so that another one may make it current.
    virtual void release() = 0;
    /// Address of an extension function, nullptr when it does not exist.
    [[nodiscard]] virtual Proc getProcAddress(const char* name) const = 0;
    /// Null if the driver does not import camera memory or uploads are faster, as with a software
    /// renderer.
    [[nodiscard]] virtual PlaneImporter* planeImporter() { return nullptr; }
    /// Message why results drawn since the last call are invalid: the GPU was reset, or a call
    /// failed. Empty when there is no fault. Never waits.
    [[nodiscard]] virtual std::optional<std::string> takeFault() = 0;
    /// True when the CPU renders instead of a GPU.
    [[nodiscard]] virtual bool isSoftware() const = 0;
    /// One line for users: "EGL surfaceless: llvmpipe (...), OpenGL ES 3.2 ..., software".
    [[nodiscard]] virtual std::string description() const = 0;
};

enum class GlDevice : std::uint8_t {
    /// A GPU; without one, or with `MFAR_GL_DEVICE=software` (environment), as Software.
    Preferred,
    Software  ///< the software renderer
};

/// Creates a context and leaves it current on the calling thread. Throws std::runtime_error that
/// names what is missing.
[[nodiscard]] std::unique_ptr<GlContext> createGlContext(GlDevice device = GlDevice::Preferred);

}  // namespace mfar
