#include "pipeline/models/environment_map.h"
#include "pipeline/models/gltf_model.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mfar;
    constexpr std::size_t kMemory = 4 << 20;
    try {
        const Environment out = parseEnvironment({data, size}, "fuzz", kMemory);
        test::requireThat(out.radiance.size() ==
                              static_cast<std::size_t>(out.size.width) * out.size.height,
                          "the number of pixels does not match the environment's size");
        for (const Eigen::Vector3f& radiance : out.radiance)
            test::requireThat(radiance.allFinite() && radiance.minCoeff() >= 0,
                              "an environment pixel is negative or not finite");
    } catch (const ModelError&) {
        return 0;
    }
    return 0;
}
