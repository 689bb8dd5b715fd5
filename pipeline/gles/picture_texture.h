#pragma once

#include "base/gl/pass.h"
#include "base/gl/texture.h"
#include "hal/plane_importer.h"
#include "pipeline/gles/yuv_params.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mfar::gpu {

/// A picture that is uploaded repeatedly, in any pixel format: grey and RGBA unchanged, BGRA by the
/// texture's swizzle, Y U V as planes that one draw converts to RGBA8. Allocates when size or
/// format change. Needs a current context for its whole lifetime.
class PictureTexture {
public:
    /// `filter`: of texture().
    explicit PictureTexture(Filter filter = Filter::Nearest) : filter_(filter) {}

    PictureTexture(const PictureTexture&) = delete;
    PictureTexture& operator=(const PictureTexture&) = delete;
    ~PictureTexture();

    /// With an importer, Y U V planes in memory that the GPU can access are read without a copy;
    /// null: always copied. The importer must outlive this.
    void setImporter(PlaneImporter* importer);

    /// The view must be valid (requireSound()). Changes the bound framebuffer.
    void upload(const ImageView& view);
    /// Waits until the memory of the last uploaded view is no longer read.
    void finishReading();
    /// Why zero-copy import failed; returned once.
    [[nodiscard]] std::optional<std::string> takeImportFault();

    /// The last upload: R8 for grey, otherwise RGBA8. Samples as R G B.
    [[nodiscard]] const Texture& texture() const { return picture_; }

private:
    /// Resources for converting Y U V pictures.
    struct Planes {
        std::array<Texture, 3> textures;  // one per plane of the format
        Framebuffer target;
        DrawPass<params::YuvPicture> pass;
    };

    using Names = std::array<GLuint, 3>;  // texture names of the planes
    struct Imported {
        std::uint64_t id;
        Names planes;
    };

    void allocate(const ImageView& view);
    void convert(const ImageView& view, const Names& planes);
    [[nodiscard]] Names uploadPlanes(const ImageView& view);
    [[nodiscard]] std::optional<Names> importPlanes(const ImageView& view);
    void forgetImported(std::size_t kept);

    Filter filter_;
    Size size_;
    PixelFormat format_ = PixelFormat::Rgba8;
    Texture picture_;
    std::optional<Planes> planes_;
    PlaneImporter* importer_ = nullptr;
    std::vector<Imported> imported_;  // most recently used last
    GLsync reading_ = nullptr;
    std::optional<std::string> importFault_;
};

}  // namespace mfar::gpu
