#include "base/image_layout.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/gles/flow2d.h"
#include "pipeline/gles/picture_texture.h"
#include "pipeline/pipeline.h"

#include <stdexcept>

namespace mfar {

std::vector<float> flowBetween(const ImageView& a, const ImageView& b) {
    if (!(a.size == b.size) || a.size.width < 16 || a.size.height < 16)
        throw std::invalid_argument(
            "the flow needs two pictures of the same size, at least 16x16 pixels");
    requireSound(a, "first picture");
    requireSound(b, "second picture");
    gpu::PictureTexture first, second;
    first.upload(a);
    second.upload(b);
    const TileBuffer tiles(a.size);
    LumaPyramids pyramids(a.size);
    Flow2d flow(a.size);
    pyramids.buildVideo(first.texture());
    pyramids.buildSecond(second.texture());
    flow.run(pyramids.luma(), tiles, false);

    const Flow2d::Field& field = flow.forward();
    const std::vector<float> cells =
        flow.cells().read<float>(4UL * field.cells.width * field.cells.height, 16UL * field.offset);
    std::vector<float> out;
    out.reserve(2UL * a.size.width * a.size.height);
    for (int y = 0; y < a.size.height; ++y)
        for (int x = 0; x < a.size.width; ++x)
            for (int channel = 0; channel < 2; ++channel)
                out.push_back(sampleCells(cells, field.cells, channel, x, y));
    return out;
}

}  // namespace mfar
