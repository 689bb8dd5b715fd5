#include "hal/device/display_scaler.h"

#include "hal/device/display_spec.h"
#include "hal/device/scale_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace mfar {
namespace {

constexpr Size kLikelyScreen{1920, 1080};
constexpr Size kFewPixels{16, 16};

using params::ScalePicture;

ScalePicture scaleParams(Size picture, Size screen, ScreenScaler::Order order) {
    const ScreenRect to = letterbox(picture, screen);
    const float x = static_cast<float>(picture.width) / static_cast<float>(to.size.width);
    const float y = static_cast<float>(picture.height) / static_cast<float>(to.size.height);
    return {.left = to.x,
            .top = to.y,
            .width = to.size.width,
            .height = to.size.height,
            .scaleX = x,
            .scaleY = y,
            .footprintX = std::max(x, 1.0F),
            .footprintY = std::max(y, 1.0F),
            .pictureWidth = picture.width,
            .pictureHeight = picture.height,
            .blueFirst = order == ScreenScaler::Order::Bgra ? 1 : 0};
}

// Returns the number of texel pairs that the shader reads along each axis for one screen pixel.
// They cover the pixel's footprint: the part of the picture whose average the pixel shows. Returns
// 0 if the picture needs no scaling.
int pairsFor(const ScalePicture& p) {
    if (p.width == p.pictureWidth && p.height == p.pictureHeight) return 0;
    const float footprint = std::max(p.footprintX, p.footprintY);
    // A footprint that begins and ends inside a texel touches one texel more than its width.
    const int texels = static_cast<int>(std::ceil(footprint)) + 1;
    return footprint <= 1.0F ? 1 : (texels + 1) / 2;
}

GLsizeiptr bytesOf(Size size) {
    return static_cast<GLsizeiptr>(size.width) * size.height * 4;
}

void requirePixels(const Picture& picture) {
    if (picture.size().width < 1 || picture.size().height < 1)
        throw std::runtime_error("a picture without pixels cannot be shown");
}

GLuint linearSampler() {
    GLuint sampler = 0;
    glGenSamplers(1, &sampler);
    glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return sampler;
}

ScreenPicture opaqueCopy(const Rows<const std::uint32_t>& rows) {
    ScreenPicture copy{rows.size, PixelFormat::Rgba8, {}};
    copy.pixels.resize(static_cast<std::size_t>(bytesOf(rows.size)));
    const std::size_t stride = static_cast<std::size_t>(rows.size.width) * 4;
    for (int y = 0; y < rows.size.height; ++y) {
        std::uint8_t* to = copy.pixels.data() + stride * static_cast<std::size_t>(y);
        std::memcpy(to, rows[y], stride);
        for (std::size_t x = 0; x < stride; x += 4)
            to[x + 3] = 255;
    }
    return copy;
}

}  // namespace

KeptTarget::KeptTarget() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack_);
    glGetIntegerv(GL_VIEWPORT, viewport_.data());
}

KeptTarget::~KeptTarget() {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(pack_));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
}

ScreenScaler::~ScreenScaler() {
    releaseGl();
}

void ScreenScaler::releaseGl() {
    copy_.reset();
    scale_.reset();
    if (sampler_ != 0) glDeleteSamplers(1, &sampler_);
    sampler_ = 0;
    upload_ = {};
}

gpu::Program& ScreenScaler::programFor(int pairs) {
    std::optional<gpu::Program>& program = pairs == 0 ? copy_ : scale_;
    if (!program || (pairs != 0 && pairs != pairs_)) {
        program.emplace("fullscreen.vert", "display_scale.frag",
                        fmt::format("#define PAIRS {}\n", pairs), sizeof(ScalePicture));
        if (pairs != 0) pairs_ = pairs;
    }
    return *program;
}

void ScreenScaler::draw(const Picture& picture, GLuint framebuffer, Size screen, Order order) {
    requirePixels(picture);
    const GlImage image = picture.isOnHost() ? uploaded(picture.rows()) : picture.image();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, screen.width, screen.height);
    render(image, screen, order);
}

GlImage ScreenScaler::uploaded(const Rows<const std::uint32_t>& rows) {
    if (upload_.size() != rows.size) upload_ = gpu::Texture(rows.size, gpu::TexelFormat::Rgba8);
    const ImageView pixels = viewOf(rows);
    upload_.upload({pixels.data, pixels.stride});
    return {upload_.id(), rows.size};
}

// Mesa compiles a shader when it is first used, so a few pixels are drawn.
void ScreenScaler::warmUp(const GlImage& picture) {
    if (copy_ || picture.size.width < 1 || picture.size.height < 1) return;
    const KeptTarget kept;
    const gpu::Texture few(kFewPixels, gpu::TexelFormat::Rgba8);
    const gpu::Framebuffer target(few);
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    glViewport(0, 0, kFewPixels.width, kFewPixels.height);
    render(picture, kLikelyScreen, Order::Bgra);
    render(picture, picture.size, Order::Bgra);
    glFinish();
}

void ScreenScaler::render(const GlImage& picture, Size screen, Order order) {
    if (sampler_ == 0) sampler_ = linearSampler();
    const ScalePicture params = scaleParams(picture.size, screen, order);
    programFor(pairsFor(params))
        .use(&params, sizeof params, {{gpu::Binding::Kind::Sampler, 0, picture.texture}});
    glBindSampler(0, sampler_);
    gpu::detail::drawFullScreen();
    glBindSampler(0, 0);
}

ScreenReader::ScreenReader(Size screen, ScreenScaler& scaler)
    : screen_(screen), scaler_(scaler), hostScaler_(screen) {}

ScreenReader::~ScreenReader() = default;

ScreenReader::Target::Target(Size screen)
    : texture(screen, gpu::TexelFormat::Rgba8), framebuffer(texture) {
    glGenBuffers(1, &packBuffer);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, packBuffer);
    glBufferData(GL_PIXEL_PACK_BUFFER, bytesOf(screen), nullptr, GL_STREAM_READ);
}

ScreenReader::Target::~Target() {
    glDeleteBuffers(1, &packBuffer);
}

void ScreenReader::begin(const Picture& picture) {
    requirePixels(picture);
    onHost_.reset();
    if (picture.isOnHost()) {
        onHost_ = hostScaler_.scaled(picture.rows());
        return;
    }
    const KeptTarget kept;
    if (!target_) target_.emplace(screen_);
    scaler_.draw(picture, target_->framebuffer.id(), screen_, ScreenScaler::Order::Bgra);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target_->framebuffer.id());
    glBindBuffer(GL_PIXEL_PACK_BUFFER, target_->packBuffer);
    glReadPixels(0, 0, screen_.width, screen_.height, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glFlush();
}

ImageView ScreenReader::map() {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, target_->packBuffer);
    const void* pixels =
        glMapBufferRange(GL_PIXEL_PACK_BUFFER, 0, bytesOf(screen_), GL_MAP_READ_BIT);
    if (pixels == nullptr) throw gpu::GlError("the picture for the screen cannot be read");
    return {static_cast<const std::uint8_t*>(pixels), screen_,
            static_cast<std::size_t>(screen_.width) * 4, PixelFormat::Bgra8};
}

void ScreenReader::unmap() {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, target_->packBuffer);
    glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
}

ScreenPicture ScreenReader::last() const {
    if (onHost_) return opaqueCopy(*onHost_);
    const KeptTarget kept;
    return readFramebuffer(target_->framebuffer.id(), screen_, PixelFormat::Bgra8);
}

ScreenPicture readFramebuffer(GLuint framebuffer, Size size, PixelFormat format) {
    ScreenPicture picture{size, format,
                          std::vector<std::uint8_t>(static_cast<std::size_t>(bytesOf(size)))};
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, picture.pixels.data());
    return picture;
}

}  // namespace mfar
