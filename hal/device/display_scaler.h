#pragma once

#include "base/gl/pass.h"
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
/// nothing but the picture and the two sizes. Needs a current context for its whole life.
class ScreenScaler {
public:
    enum class Order { Rgba, Bgra };

    ScreenScaler();
    ScreenScaler(const ScreenScaler&) = delete;
    ScreenScaler& operator=(const ScreenScaler&) = delete;
    ~ScreenScaler();

    /// Fills `framebuffer` (row 0 = top row), of `screen` pixels. Throws std::runtime_error for a
    /// picture without pixels.
    void draw(const GlImage& picture, GLuint framebuffer, Size screen, Order order);
    /// Compiles what a screen of 1280x720 to 1920x1080 will most likely need, unless something has
    /// been compiled already, so that its first picture does not wait for it.
    void warmUp(const GlImage& picture);

private:
    void render(const GlImage& picture, Size screen, Order order);
    [[nodiscard]] gpu::Program& programFor(int pairs);

    // Of pictures of the screen's size; for footprints that touch up to `pairs_` pairs of texels in
    // a row.
    std::optional<gpu::Program> copy_, scale_;
    int pairs_ = 0;
    GLuint sampler_ = 0;
};

/// Pictures scaled for a screen that is written by the CPU. Needs a current context.
class ScreenReader {
public:
    /// `scaler` must outlive it.
    ScreenReader(Size screen, ScreenScaler& scaler);
    ScreenReader(const ScreenReader&) = delete;
    ScreenReader& operator=(const ScreenReader&) = delete;
    ~ScreenReader();

    /// Starts drawing and reading back; waits for nothing.
    void begin(const GlImage& picture);
    /// The pixels of the last begin(), Bgra8 with alpha 255: waits for the GPU, calls
    /// `take(const ImageView&)`, whose pixels are gone when it returns and which must not throw.
    template <class Take>
    void finish(Take take) {
        take(map());
        unmap();
    }
    /// A copy of the last picture begun.
    [[nodiscard]] ScreenPicture last() const;

private:
    [[nodiscard]] ImageView map();
    void unmap();

    ScreenScaler& scaler_;
    gpu::Texture texture_;
    gpu::Framebuffer framebuffer_;
    GLuint packBuffer_ = 0;
};

/// The pixels of a framebuffer as they are stored. Waits for the GPU.
[[nodiscard]] ScreenPicture readFramebuffer(GLuint framebuffer, Size size, PixelFormat format);

}  // namespace mfar
