#pragma once

#include "hal/plane_importer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// An OpenGL ES 3.1 capable context without a window. Belongs to the thread that made it current.
/// Which one is linked (EGL or OSMesa) is decided at link time: both define createGlContext().
class GlContext {
public:
    using Proc = void (*)();

    virtual ~GlContext() = default;

    virtual void makeCurrent() = 0;
    /// Unbinds from this thread, so that another one may make it current.
    virtual void release() = 0;
    /// Address of an extension function, nullptr when it does not exist.
    [[nodiscard]] virtual Proc getProcAddress(const char* name) const = 0;
    /// Nothing where the driver imports no memory of cameras, or reads faster what is uploaded: a
    /// software renderer.
    [[nodiscard]] virtual PlaneImporter* planeImporter() { return nullptr; }
    /// Why nothing that was drawn since the last call can be trusted, for people: the GPU was
    /// reset, or a call failed. Nothing when all is well. Never waits.
    [[nodiscard]] virtual std::optional<std::string> takeFault() = 0;
    /// Does the processor draw, not a GPU?
    [[nodiscard]] virtual bool isSoftware() const = 0;
    /// One line for people: "EGL surfaceless: llvmpipe (...), OpenGL ES 3.2 ..., software".
    [[nodiscard]] virtual std::string description() const = 0;
};

enum class GlDevice : std::uint8_t {
    Preferred,  ///< a GPU; without one, or with `MFAR_GL_DEVICE=software` (environment), the next
    Software    ///< the software renderer
};

/// Creates a context and leaves it current on the calling thread. Throws std::runtime_error naming
/// what is missing.
[[nodiscard]] std::unique_ptr<GlContext> createGlContext(GlDevice device = GlDevice::Preferred);

}  // namespace mfar
