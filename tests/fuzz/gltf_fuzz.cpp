#include "pipeline/models/gltf_model.h"
#include "tests/fuzz/sound_model.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mfar;
    ModelLimits limits;  // small, so that a huge count is refused early
    limits.bytes = 1U << 20U;
    limits.vertices = limits.triangles = 10'000;
    limits.elements = 1'000;
    limits.jsonValues = 10'000;
    limits.texels = 1U << 16U;
    try {
        test::requireSoundModel(parseGltf({data, size}, "fuzz", {}, limits));
    } catch (const ModelError&) {
        return 0;
    }
    return 0;
}
