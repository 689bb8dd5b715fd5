#pragma once

#include "base/gl/pass.h"
#include "hal/device/display_host_scaler.h"
#include "hal/display.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Gives the caller of a display back its targets: framebuffers, viewport, pack buffer. What else
/// the classes below bind, every pass of the pipeline binds anew.
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

/// Draws pictures screen-sized: aspect kept (letterbox()), black around them; an area filter where
/// they shrink, linear interpolation where they grow, exact at equal size. What it draws depends on
/// nothing but the picture and the two sizes. A picture on the host is uploaded first. Needs the
/// context from the first picture on for its whole life.
class ScreenScaler {
public:
    enum class Order { Rgba, Bgra };

    ScreenScaler() = default;
    ScreenScaler(const ScreenScaler&) = delete;
    ScreenScaler& operator=(const ScreenScaler&) = delete;
    ~ScreenScaler();

    /// Fills `framebuffer` (row 0 = top row), of `screen` pixels, and leaves it bound. Throws
    /// std::runtime_error for a picture without pixels.
    void draw(const Picture& picture, GLuint framebuffer, Size screen, Order order);
    /// See Display::releaseGl().
    void releaseGl();
    /// Compiles what a screen of 1280x720 to 1920x1080 will most likely need, unless something has
    /// been compiled already, so that its first picture does not wait for it.
    void warmUp(const GlImage& picture);

private:
    [[nodiscard]] GlImage uploaded(const Rows<const std::uint32_t>& rows);
    void render(const GlImage& picture, Size screen, Order order);
    [[nodiscard]] gpu::Program& programFor(int pairs);

    // Of pictures of the screen's size; for footprints that touch up to `pairs_` pairs of texels in
    // a row.
    std::optional<gpu::Program> copy_, scale_;
    int pairs_ = 0;
    GLuint sampler_ = 0;
    gpu::Texture upload_;
};

/// Pictures scaled for a screen that is written by the CPU: a texture on the GPU, from where it is
/// read back; rows of the host on the host, without GL. Gives the caller's targets back. Needs the
/// context from the first texture on for its whole life.
class ScreenReader {
public:
    /// `scaler` must outlive it.
    ScreenReader(Size screen, ScreenScaler& scaler);
    ScreenReader(const ScreenReader&) = delete;
    ScreenReader& operator=(const ScreenReader&) = delete;
    ~ScreenReader();

    /// Starts drawing and reading a texture back, waits for nothing; scales rows of the host.
    /// Throws std::runtime_error for a picture without pixels.
    void begin(const Picture& picture);
    /// The pixels of the last begin(), Bgra8 with alpha 255 or Rgba8: waits for the GPU, calls
    /// `take(const ImageView&)`, whose pixels are gone when it returns and which must not throw.
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
    /// See Display::releaseGl(). There is no last picture then, unless it is on the host.
    void releaseGl() { target_.reset(); }
    /// A copy of the last picture begun, alpha 255.
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
    std::optional<Target> target_;  ///< once there has been a texture
    HostScaler hostScaler_;
    std::optional<Rows<const std::uint32_t>> onHost_;  ///< the picture begun, where it is there
};

/// The pixels of a framebuffer as they are stored. Waits for the GPU.
[[nodiscard]] ScreenPicture readFramebuffer(GLuint framebuffer, Size size, PixelFormat format);

}  // namespace mfar
