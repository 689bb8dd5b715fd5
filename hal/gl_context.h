#pragma once

#include "hal/plane_importer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// An OpenGL ES 3.1 context without a window. Only the thread that made it current may use it.
class GlContext {
public:
    using Proc = void (*)();

    virtual ~GlContext() = default;

    virtual void makeCurrent() = 0;
    virtual void release() = 0;
    [[nodiscard]] virtual Proc getProcAddress(const char* name) const = 0;
    /// Returns null if the driver cannot import camera memory, or if uploads are faster than
    /// imports, e.g. with a software renderer.
    [[nodiscard]] virtual PlaneImporter* planeImporter() { return nullptr; }
    /// Returns the reason why pictures drawn since the last call are invalid: a GPU reset or a
    /// failed GL call. Returns nothing if there was no fault. Never waits.
    [[nodiscard]] virtual std::optional<std::string> takeFault() = 0;
    [[nodiscard]] virtual bool isSoftware() const = 0;
    /// Returns a line for users, such as "EGL surfaceless: llvmpipe (...), OpenGL ES 3.2 ...,
    /// software".
    [[nodiscard]] virtual std::string description() const = 0;
};

enum class GlDevice : std::uint8_t {
    /// Use the GPU. If there is no GPU, or the environment has MFAR_GL_DEVICE=software, use the
    /// software renderer.
    Preferred,
    Software
};

/// Creates a context and makes it current on the calling thread. Throws std::runtime_error with the
/// name of the missing library or feature, or if MFAR_GL_DEVICE has another value than "software".
[[nodiscard]] std::unique_ptr<GlContext> createGlContext(GlDevice device = GlDevice::Preferred);

}  // namespace mfar
