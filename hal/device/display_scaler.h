#pragma once

#include "base/gl/pass.h"
#include "hal/device/display_host_scaler.h"
#include "hal/display.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Saves the bound framebuffers, pixel pack buffer and viewport, and restores them at destruction.
/// Other bindings are not restored, because every pass of the pipeline sets its own.
class KeptTarget {
public:
    KeptTarget();
    KeptTarget(const KeptTarget&) = delete;
    KeptTarget& operator=(const KeptTarget&) = delete;
    ~KeptTarget();

private:
    GLint draw_ = 0, read_ = 0, pack_ = 0;
    std::array<GLint, 4> viewport_{};
};

/// Draws pictures in the screen's size. The aspect ratio is kept, with black borders (letterbox()).
/// A picture is reduced by averaging areas and enlarged by linear interpolation. A picture that
/// needs no scaling is copied unchanged. From the first picture on, the GL context must exist until
/// releaseGl().
class ScreenScaler {
public:
    enum class Order { Rgba, Bgra };

    ScreenScaler() = default;
    ScreenScaler(const ScreenScaler&) = delete;
    ScreenScaler& operator=(const ScreenScaler&) = delete;
    ~ScreenScaler();

    /// Draws the picture over all of `framebuffer`, which has the size `screen` and stays bound.
    /// Row 0 is the top row. Throws std::runtime_error for an empty picture.
    void draw(const Picture& picture, GLuint framebuffer, Size screen, Order order);
    void releaseGl();
    /// Compiles the shaders for pictures of this size on a screen of 1920x1080 pixels and on a
    /// screen of the picture's size. Most screens need one of these shaders, so their first picture
    /// is not delayed.
    void warmUp(const GlImage& picture);

private:
    [[nodiscard]] GlImage uploaded(const Rows<const std::uint32_t>& rows);
    void render(const GlImage& picture, Size screen, Order order);
    [[nodiscard]] gpu::Program& programFor(int pairs);

    // copy_ draws pictures that need no scaling. scale_ draws other pictures. For each screen
    // pixel, it reads pairs_ pairs of texels along each axis.
    std::optional<gpu::Program> copy_, scale_;
    int pairs_ = 0;
    GLuint sampler_ = 0;
    gpu::Texture upload_;
};

/// Scales pictures for a screen whose memory the CPU writes. The GPU scales textures, which are
/// then read back. The CPU scales pictures on the host, without GL. From the first texture on, the
/// GL context must exist until releaseGl(). `scaler` must outlive this object.
class ScreenReader {
public:
    ScreenReader(Size screen, ScreenScaler& scaler);
    ScreenReader(const ScreenReader&) = delete;
    ScreenReader& operator=(const ScreenReader&) = delete;
    ~ScreenReader();

    /// Starts to draw a texture and to read it back, without waiting. A picture on the host is
    /// scaled at once. Throws std::runtime_error for an empty picture.
    void begin(const Picture& picture);
    /// Waits for the GPU and calls `take(const ImageView&)` with the pixels of the last begin().
    /// The pixels are Bgra8 with alpha 255, or Rgba8 for a picture on the host. They are valid only
    /// during the call. `take` must not throw.
    template <class Take>
    void finish(Take take) {
        if (onHost_) {
            take(viewOf(*onHost_));
            return;
        }
        const KeptTarget kept;
        take(map());
        unmap();
    }
    /// Deletes all GL objects. After that, last() must not be called unless the last picture is on
    /// the host.
    void releaseGl() { target_.reset(); }
    [[nodiscard]] ScreenPicture last() const;

private:
    struct Target {
        explicit Target(Size screen);
        Target(const Target&) = delete;
        Target& operator=(const Target&) = delete;
        ~Target();

        gpu::Texture texture;
        gpu::Framebuffer framebuffer;
        GLuint packBuffer = 0;
    };
    [[nodiscard]] ImageView map();
    void unmap();

    Size screen_;
    ScreenScaler& scaler_;
    std::optional<Target> target_;
    HostScaler hostScaler_;
    std::optional<Rows<const std::uint32_t>> onHost_;
};

[[nodiscard]] ScreenPicture readFramebuffer(GLuint framebuffer, Size size, PixelFormat format);

}  // namespace mfar
