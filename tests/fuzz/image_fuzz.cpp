#include "hal/image_codec.h"
#include "tests/fuzz/target.h"

#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mfar;
    constexpr int kMostSide = 512;
    for (const ImageAlpha alpha : {ImageAlpha::Opaque, ImageAlpha::Kept}) {
        std::vector<std::uint8_t> rgba;
        bool asked = false;
        try {
            decodeImage(
                {data, size},
                [&](Size found) -> PixelTarget {
                    if (found.width < 1 || found.height < 1 || found.width > kMostSide ||
                        found.height > kMostSide)
                        throw std::runtime_error("too large");
                    test::requireThat(!asked, "the decoder requested memory twice");
                    asked = true;
                    const std::size_t stride = std::size_t{4} * found.width;
                    rgba.resize(stride * found.height);
                    return {rgba.data(), stride};
                },
                alpha);
            test::requireThat(asked, "the decoder accepted a picture without requesting memory");
        } catch (const std::runtime_error&) {
            continue;
        }
    }
    return 0;
}
