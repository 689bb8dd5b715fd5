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

/// A texture into which pictures of any pixel format are uploaded. A shader converts Y U V pictures
/// to RGBA8; other formats are uploaded unchanged. Memory is allocated when size or format change.
/// The object needs a current GL context for its whole lifetime.
class PictureTexture {
public:
    explicit PictureTexture(Filter filter = Filter::Nearest) : filter_(filter) {}

    PictureTexture(const PictureTexture&) = delete;
    PictureTexture& operator=(const PictureTexture&) = delete;
    ~PictureTexture();

    /// Sets the importer that lets the GPU read Y U V planes without a copy. Null: the planes are
    /// always copied. The importer must outlive this object.
    void setImporter(PlaneImporter* importer);

    /// The view must be valid (requireSound()). May change the GL framebuffer binding.
    void upload(const ImageView& view);
    /// Waits until the GPU no longer reads the memory of the last uploaded view, but at most
    /// kLongestGpuWait.
    void finishReading();
    /// Returns the reason if an import of camera memory has failed since the last call, otherwise
    /// nullopt.
    [[nodiscard]] std::optional<std::string> takeImportFault();

    /// The last uploaded picture: R8 for grey, otherwise RGBA8. Sampling gives R, G and B in this
    /// order even if the picture was BGRA.
    [[nodiscard]] const Texture& texture() const { return picture_; }

private:
    struct Planes {
        std::array<Texture, 3> textures;
        Framebuffer target;
        DrawPass<params::YuvPicture> pass;
    };

    using Names = std::array<GLuint, 3>;
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
    std::vector<Imported> imported_;
    GLsync reading_ = nullptr;
    std::optional<std::string> importFault_;
};

}  // namespace mfar::gpu
