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

/// A texture into which pictures of any pixel format are uploaded. Grey and RGBA are uploaded
/// unchanged. For BGRA, the texture's channels are swizzled. Y U V pictures are uploaded as planes,
/// and a shader converts them to RGBA8. Memory is allocated when size or format change. The object
/// needs a current GL context for its whole lifetime.
class PictureTexture {
public:
    /// `filter` is the filter of texture().
    explicit PictureTexture(Filter filter = Filter::Nearest) : filter_(filter) {}

    PictureTexture(const PictureTexture&) = delete;
    PictureTexture& operator=(const PictureTexture&) = delete;
    ~PictureTexture();

    /// Sets the importer, with which the GPU reads Y U V planes without a copy if it can access
    /// their memory. Null: the planes are always copied. The importer must outlive this object.
    void setImporter(PlaneImporter* importer);

    /// The view must be valid (requireSound()). Changes the GL framebuffer binding.
    void upload(const ImageView& view);
    /// Waits until the GPU no longer reads the memory of the last uploaded view.
    void finishReading();
    /// Returns why an import of camera memory without a copy failed. Each failure is returned once;
    /// empty: there was none.
    [[nodiscard]] std::optional<std::string> takeImportFault();

    /// The last uploaded picture: R8 for grey, otherwise RGBA8. Sampling it gives R, G and B.
    [[nodiscard]] const Texture& texture() const { return picture_; }

private:
    /// GL objects that convert Y U V pictures.
    struct Planes {
        std::array<Texture, 3> textures;  // one for each plane of the format
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
    std::vector<Imported> imported_;  // the most recently used is last
    GLsync reading_ = nullptr;
    std::optional<std::string> importFault_;
};

}  // namespace mfar::gpu
