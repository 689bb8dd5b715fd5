#include "pipeline/track/tag_map.h"
#include "tests/fuzz/target.h"

namespace {

template <class Read>
void tryTo(const Read& read) {
    try {
        const mfar::TagMap map = read();
        mfar::test::requireThat(!map.empty(), "an accepted tag map has no tags");
        for (const auto& [key, tag] : map.tags())
            mfar::test::requireThat(tag.size > 0 && tag.T_world_tag.translation.allFinite() &&
                                        tag.T_world_tag.rotation.coeffs().allFinite(),
                                    "an accepted tag has no positive size or no finite pose");
        mfar::test::requireThat(mfar::tagMapFromToml(mfar::tomlOf(map), "again").tags().size() ==
                                    map.tags().size(),
                                "a saved tag map differs when read again");
    } catch (const mfar::TagMapError&) {
        return;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = mfar::test::textOf(data, size);
    tryTo([&] { return mfar::tagMapFromToml(text, "fuzz.toml"); });
    tryTo([&] { return mfar::tagMapFromRosYaml(text, "fuzz.yaml"); });
    return 0;
}
