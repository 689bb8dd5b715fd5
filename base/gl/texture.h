#pragma once

#include "base/gl/gl.h"
#include "base/image_view.h"

#include <array>
#include <span>
#include <vector>

namespace mfar::gpu {

/// The storage formats in use. OpenGL ES 3.1 allows each of them as a texture. Drawing into a float
/// format needs EXT_color_buffer_float or OpenGL ES 3.2. If the driver has neither, Framebuffer
/// throws.
enum class TexelFormat : GLenum {
    R8 = GL_R8,
    Rg8 = GL_RG8,
    Rgba8 = GL_RGBA8,
    Srgb8Alpha8 = GL_SRGB8_ALPHA8,
    R16F = GL_R16F,
    Rg16F = GL_RG16F,
    Rgba16F = GL_RGBA16F,
    R32F = GL_R32F,
    Rg32F = GL_RG32F,
    Rgba32F = GL_RGBA32F,
    R16I = GL_R16I,
    Rgba16I = GL_RGBA16I,
    R32Ui = GL_R32UI,
    Rg32Ui = GL_RG32UI,
    Rgba32Ui = GL_RGBA32UI,
    Rgb9E5 = GL_RGB9_E5,
    Depth24 = GL_DEPTH_COMPONENT24,
};

enum class Filter { Nearest, Linear };

/// Returns the largest width and height of a texture on this GPU. Needs a current GL context.
[[nodiscard]] int largestTexture();

/// A 2-D texture of fixed size and format. R8 textures are sampled as grey. Move-only. Its GL
/// context must be current whenever the object is used or destroyed. Throws GlError if the driver
/// refuses the size or format.
class Texture {
public:
    Texture() = default;
    Texture(Size size, TexelFormat format, Filter filter = Filter::Nearest, int levels = 1);
    Texture(Texture&& other) noexcept;
    Texture& operator=(Texture&& other) noexcept;
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;
    ~Texture();

    [[nodiscard]] GLuint id() const { return id_; }
    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] TexelFormat format() const { return format_; }

    /// Replaces the pixels of an R8, Rg8 or Rgba8 texture (asserted). `rows` has the texture's
    /// size. The upload is slow if the stride of `rows` is not a multiple of the texel's size.
    /// Except for uploadLevel(), all functions of this class access mipmap level 0 only.
    void upload(const PlaneView& rows);
    /// Replaces rows of an R32F, Rg32F or Rgba32F texture (asserted), beginning at `firstRow`.
    /// `values` holds whole rows without padding (asserted). A texel has one, two or four floats.
    void upload(std::span<const float> values, int firstRow = 0);
    /// Replaces rows of an Rgba8 texture, beginning at `firstRow`. `texels` has whole rows without
    /// padding (asserted).
    void uploadRows(std::span<const std::array<std::uint8_t, 4>> texels, int firstRow = 0);
    /// Replaces rows of an R32Ui, Rg32Ui, Rgba32Ui or Rgb9E5 texture (asserted), beginning at
    /// `firstRow`. `values` holds whole rows without padding (asserted). A texel has one integer in
    /// R32Ui and Rgb9E5, two in Rg32Ui and four in Rgba32Ui.
    void upload(std::span<const std::uint32_t> values, int firstRow = 0);
    /// Replaces mipmap level `level` of an Srgb8Alpha8 texture (asserted). `size` is the size of
    /// that level.
    void uploadLevel(int level, Size size, std::span<const std::array<std::uint8_t, 4>> texels);
    /// Makes the texture repeat outside of [0, 1].
    void repeat() const;
    /// Returns the texture as RGBA8, row 0 first. Waits for the GPU. Too slow to be called in every
    /// frame.
    [[nodiscard]] std::vector<std::uint8_t> readRgba8() const;
    /// Returns four floats per texel. Waits for the GPU. Too slow to be called in every frame.
    [[nodiscard]] std::vector<float> readRgba32F() const;

private:
    GLuint id_ = 0;
    Size size_;
    TexelFormat format_ = TexelFormat::Rgba8;
};

/// A framebuffer that draws into one or more textures. Move-only; does not own the textures.
class Framebuffer {
public:
    Framebuffer() = default;
    explicit Framebuffer(std::span<const Texture* const> colour, const Texture* depth = nullptr);
    explicit Framebuffer(const Texture& colour);
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;
    Framebuffer(const Framebuffer&) = delete;
    Framebuffer& operator=(const Framebuffer&) = delete;
    ~Framebuffer();

    void bind() const;
    [[nodiscard]] GLuint id() const { return id_; }
    [[nodiscard]] Size size() const { return size_; }

private:
    GLuint id_ = 0;
    Size size_;
};

}  // namespace mfar::gpu
