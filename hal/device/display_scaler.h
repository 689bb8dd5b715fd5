#pragma once

#include "base/gl/pass.h"
#include "hal/device/display_host_scaler.h"
#include "hal/display.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Restores the caller's framebuffers, viewport and pack buffer. Other bindings are not restored:
/// every pass of the pipeline sets them.
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

/// Draws pictures screen-sized: keeps the aspect (letterbox()), black borders; area filter when
/// shrinking, linear interpolation when enlarging, exact at equal size. The result depends only on
/// the picture and the two sizes. A picture on the host is uploaded first. Needs the context from
/// the first picture on.
class ScreenScaler {
public:
    enum class Order { Rgba, Bgra };

    ScreenScaler() = default;
    ScreenScaler(const ScreenScaler&) = delete;
    ScreenScaler& operator=(const ScreenScaler&) = delete;
    ~ScreenScaler();

    /// Draws the picture over all of `framebuffer` (row 0 = top row; size `screen`) and leaves it
    /// bound. Throws std::runtime_error for an empty picture.
    void draw(const Picture& picture, GLuint framebuffer, Size screen, Order order);
    /// See Display::releaseGl().
    void releaseGl();
    /// Compiles the most likely shaders for screens of 1280x720 to 1920x1080 unless one has been
    /// compiled already, so that the first picture is not delayed.
    void warmUp(const GlImage& picture);

private:
    [[nodiscard]] GlImage uploaded(const Rows<const std::uint32_t>& rows);
    void render(const GlImage& picture, Size screen, Order order);
    [[nodiscard]] gpu::Program& programFor(int pairs);

    // copy_: for pictures of the screen's size; scale_: for footprints of up to `pairs_` pairs of
    // texels in a row.
    std::optional<gpu::Program> copy_, scale_;
    int pairs_ = 0;
    GLuint sampler_ = 0;
    gpu::Texture upload_;
};

/// Scales pictures for a screen that the CPU writes: a texture is scaled on the GPU and read back;
/// rows on the host are scaled on the host, without GL. Restores the caller's targets. Needs the
/// context from the first texture on.
class ScreenReader {
public:
    /// `scaler` must outlive it.
    ScreenReader(Size screen, ScreenScaler& scaler);
    ScreenReader(const ScreenReader&) = delete;
    ScreenReader& operator=(const ScreenReader&) = delete;
    ~ScreenReader();

    /// Starts drawing and reading back a texture without waiting; scales rows on the host. Throws
    /// std::runtime_error for an empty picture.
    void begin(const Picture& picture);
    /// Waits for the GPU and calls `take(const ImageView&)` with the pixels of the last begin(),
    /// Bgra8 with alpha 255 or Rgba8. They are valid only during the call. `take` must not throw.
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
    /// See Display::releaseGl(). Afterwards there is no last picture unless it is on the host.
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
    std::optional<Target> target_;  ///< after the first texture
    HostScaler hostScaler_;
    std::optional<Rows<const std::uint32_t>> onHost_;  ///< the picture begun if it is on the host
};

/// The pixels of a framebuffer as stored. Waits for the GPU.
[[nodiscard]] ScreenPicture readFramebuffer(GLuint framebuffer, Size size, PixelFormat format);

}  // namespace mfar
