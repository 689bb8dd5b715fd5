#include "pipeline/gpu/picture_texture.h"

#include "hal/image_layout.h"

#include <string_view>

namespace mfar::gpu {
namespace {

bool isYuv(PixelFormat format) {
    return format == PixelFormat::Yuyv || format == PixelFormat::Nv12 ||
           format == PixelFormat::Yuv420;
}

std::string_view variantOf(PixelFormat format) {
    if (format == PixelFormat::Yuyv) return "#define PACKED 1\n";
    return format == PixelFormat::Nv12 ? "#define PAIRS 1\n" : "";
}

Texture planeTexture(PixelFormat format, Size size, int plane) {
    const Size half{size.width / 2, size.height / 2};
    if (format == PixelFormat::Yuyv)
        return Texture({half.width, size.height}, TexelFormat::Rgba8, Filter::Linear);
    if (plane == 0) return Texture(size, TexelFormat::R8);
    return Texture(half, format == PixelFormat::Nv12 ? TexelFormat::Rg8 : TexelFormat::R8,
                   Filter::Linear);
}

}  // namespace

void PictureTexture::allocate(const ImageView& view) {
    planes_.reset();
    picture_ =
        Texture(view.size, view.format == PixelFormat::Gray8 ? TexelFormat::R8 : TexelFormat::Rgba8,
                filter_);
    if (view.format == PixelFormat::Bgra8) {
        glBindTexture(GL_TEXTURE_2D, picture_.id());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, GL_BLUE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, GL_RED);
    }
    if (isYuv(view.format)) {
        planes_.emplace(Planes{{},
                               Framebuffer(picture_),
                               DrawPass<Params>("picture_from_yuv.frag", variantOf(view.format))});
        for (int i = 0; i < planeCount(view.format); ++i)
            planes_->textures[static_cast<std::size_t>(i)] =
                planeTexture(view.format, view.size, i);
    }
    size_ = view.size;
    format_ = view.format;
}

void PictureTexture::upload(const ImageView& view) {
    if (picture_.id() == 0 || view.size != size_ || view.format != format_) allocate(view);
    if (planes_)
        convert(view);
    else
        picture_.upload(PlaneView{view.data, view.stride});
}

void PictureTexture::convert(const ImageView& view) {
    const auto& [first, second, third] = planes_->textures;
    planes_->textures[0].upload(PlaneView{view.data, view.stride});
    for (std::size_t i = 1; i < static_cast<std::size_t>(planeCount(view.format)); ++i)
        planes_->textures[i].upload(view.chroma[i - 1]);
    const YuvToRgb rows = yuvToRgb(view.matrix, view.range);
    Params params{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            params.rows[i][j] = rows[i][j];
        params.rows[i][3] = rows[i][3] / 255;
    }
    params.step[0] = 1.0F / static_cast<float>(size_.width);
    params.step[1] = 1.0F / static_cast<float>(size_.height);
    planes_->pass.run(params, {sampler(0, first), sampler(1, second), sampler(2, third)},
                      planes_->target);
}

}  // namespace mfar::gpu
