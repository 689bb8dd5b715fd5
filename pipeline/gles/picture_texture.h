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

/// The picture that is uploaded again and again, whatever its pixel format: grey and RGBA as they
/// are, BGRA by the texture's swizzle, Y U V as planes that one draw turns into RGBA8. Allocates
/// when size or format change. Needs a current context for its whole life.
class PictureTexture {
public:
    /// `filter` of texture().
    explicit PictureTexture(Filter filter = Filter::Nearest) : filter_(filter) {}

    PictureTexture(const PictureTexture&) = delete;
    PictureTexture& operator=(const PictureTexture&) = delete;
    ~PictureTexture();

    /// Planes of Y U V in memory that the GPU can read are read from there, without a copy; null:
    /// never. It must outlive this.
    void setImporter(PlaneImporter* importer);

    /// The view is sound (requireSound()). Leaves another framebuffer bound than it found.
    void upload(const ImageView& view);
    /// Until this the memory of the view that was uploaded last may still be read. Waits for that.
    void finishReading();
    /// Why memory that is shared is copied all the same; told once.
    [[nodiscard]] std::optional<std::string> takeImportFault();

    /// As of the last upload: R8 for grey, otherwise RGBA8. Samples as R G B.
    [[nodiscard]] const Texture& texture() const { return picture_; }

private:
    /// What pictures in Y U V need on their way.
    struct Planes {
        std::array<Texture, 3> textures;  // as many as the format has planes
        Framebuffer target;
        DrawPass<params::YuvPicture> pass;
    };

    using Names = std::array<GLuint, 3>;  // of the planes' textures
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
    std::vector<Imported> imported_;  // the one used last at the end
    GLsync reading_ = nullptr;
    std::optional<std::string> importFault_;
};

}  // namespace mfar::gpu
