#pragma once

#include "hal/plane_importer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// An OpenGL ES 3.1 context without a window. Only the thread that made it current may use it.
/// createGlContext() exists in two libraries, one for EGL and one for OSMesa; each program links
/// one.
class GlContext {
public:
    using Proc = void (*)();

    virtual ~GlContext() = default;

    virtual void makeCurrent() = 0;
    /// Releases the context from this thread, so that another thread can make it current.
    virtual void release() = 0;
    /// Returns the address of an extension function; null if it does not exist.
    [[nodiscard]] virtual Proc getProcAddress(const char* name) const = 0;
    /// Returns the importer of camera memory into this context. Returns null if the driver cannot
    /// import such memory, or if uploads are faster, as with a software renderer.
    [[nodiscard]] virtual PlaneImporter* planeImporter() { return nullptr; }
    /// Returns why the pictures that were drawn since the last call are invalid: the GPU was reset,
    /// or a GL call failed. Returns nothing if there was no fault. Never waits.
    [[nodiscard]] virtual std::optional<std::string> takeFault() = 0;
    /// Returns whether the CPU renders instead of a GPU.
    [[nodiscard]] virtual bool isSoftware() const = 0;
    /// Returns a line for users, such as "EGL surfaceless: llvmpipe (...), OpenGL ES 3.2 ...,
    /// software".
    [[nodiscard]] virtual std::string description() const = 0;
};

enum class GlDevice : std::uint8_t {
    /// The GPU. The software renderer is used if there is no GPU or the environment has
    /// MFAR_GL_DEVICE=software.
    Preferred,
    Software  ///< the software renderer, even if there is a GPU
};

/// Creates a context and makes it current on the calling thread. Throws a std::runtime_error that
/// names what is missing.
[[nodiscard]] std::unique_ptr<GlContext> createGlContext(GlDevice device = GlDevice::Preferred);

}  // namespace mfar
