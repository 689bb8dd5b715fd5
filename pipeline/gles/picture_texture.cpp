#include "pipeline/gles/picture_texture.h"

#include "base/gl/fence.h"
#include "base/image_layout.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mfar::gpu {
namespace {

// Largest number of imported camera buffers. A camera has fewer buffers, but it gets new ones when
// it is opened again.
constexpr std::size_t kMostImported = 16;
constexpr GLuint64 kLongestRead = std::chrono::nanoseconds(kLongestGpuWait).count();

int channelsOf(TexelFormat format) {
    if (format == TexelFormat::R8) return 1;
    return format == TexelFormat::Rg8 ? 2 : 4;
}

void setSampling(GLint filter) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

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
        planes_.emplace(
            Planes{{},
                   Framebuffer(picture_),
                   DrawPass<params::YuvPicture>("picture_from_yuv.frag", variantOf(view.format))});
        for (int i = 0; i < planeCount(view.format); ++i)
            planes_->textures[static_cast<std::size_t>(i)] =
                planeTexture(view.format, view.size, i);
    }
    size_ = view.size;
    format_ = view.format;
}

PictureTexture::~PictureTexture() {
    finishReading();
    forgetImported(0);
}

void PictureTexture::setImporter(PlaneImporter* importer) {
    finishReading();
    forgetImported(0);
    importer_ = importer;
}

void PictureTexture::forgetImported(std::size_t kept) {
    while (imported_.size() > kept) {
        for (const GLuint plane : imported_.front().planes)
            if (plane != 0) importer_->forget(plane);
        imported_.erase(imported_.begin());
    }
}

void PictureTexture::upload(const ImageView& view) {
    if (picture_.id() == 0 || view.size != size_ || view.format != format_) {
        finishReading();
        forgetImported(0);
        allocate(view);
    }
    if (!planes_) return picture_.upload(PlaneView{view.data, view.stride});
    const std::optional<Names> imported = importPlanes(view);
    convert(view, imported ? *imported : uploadPlanes(view));
    if (imported) {
        finishReading();
        reading_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    }
}

void PictureTexture::finishReading() {
    if (reading_ == nullptr) return;
    glClientWaitSync(reading_, GL_SYNC_FLUSH_COMMANDS_BIT, kLongestRead);
    glDeleteSync(reading_);
    reading_ = nullptr;
}

std::optional<std::string> PictureTexture::takeImportFault() {
    return std::exchange(importFault_, std::nullopt);
}

// Imports the planes of a picture without a copy. A driver that rejects one picture also rejects
// the next ones, so a failure ends all imports.
std::optional<PictureTexture::Names> PictureTexture::importPlanes(const ImageView& view) {
    if (importer_ == nullptr || view.shared == nullptr) return {};
    const auto known = std::ranges::find(imported_, view.shared->id, &Imported::id);
    if (known != imported_.end()) {
        std::rotate(known, known + 1, imported_.end());
        return imported_.back().planes;
    }
    Names names{};
    try {
        for (std::size_t i = 0; i < static_cast<std::size_t>(planeCount(view.format)); ++i) {
            const Texture& like = planes_->textures[i];
            const auto& [fd, offset] = view.shared->planes[i];
            const std::size_t stride = i == 0 ? view.stride : view.chroma[i - 1].stride;
            names[i] =
                importer_->import({fd, offset, stride, like.size(), channelsOf(like.format())});
            glBindTexture(GL_TEXTURE_2D, names[i]);
            const GLint filter =
                view.format != PixelFormat::Yuyv && i == 0 ? GL_NEAREST : GL_LINEAR;
            setSampling(filter);
        }
    } catch (const std::runtime_error& error) {
        importFault_ = error.what();
        for (const GLuint name : names)
            if (name != 0) importer_->forget(name);
        forgetImported(0);
        importer_ = nullptr;
        return {};
    }
    forgetImported(kMostImported - 1);
    imported_.push_back({view.shared->id, names});
    return names;
}

PictureTexture::Names PictureTexture::uploadPlanes(const ImageView& view) {
    Names names{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(planeCount(view.format)); ++i) {
        planes_->textures[i].upload(i == 0 ? PlaneView{view.data, view.stride}
                                           : view.chroma[i - 1]);
        names[i] = planes_->textures[i].id();
    }
    return names;
}

void PictureTexture::convert(const ImageView& view, const Names& planes) {
    const YuvToRgb rows = yuvToRgb(view.matrix, view.range);
    const auto rowOf = [](const auto& r) { return params::Row4{r[0], r[1], r[2], r[3] / 255}; };
    const params::YuvPicture p{.rows = {rowOf(rows[0]), rowOf(rows[1]), rowOf(rows[2])},
                               .texelX = 1.0F / static_cast<float>(size_.width),
                               .texelY = 1.0F / static_cast<float>(size_.height)};
    const auto plane = [&](GLuint unit) {
        return Binding{Binding::Kind::Sampler, unit, planes[unit]};
    };
    planes_->pass.run(p, {plane(0), plane(1), plane(2)}, planes_->target);
}

}  // namespace mfar::gpu
