#include "daemon/config.h"
#include "daemon/quality_table.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mfar;
    std::vector<QualityLevel> levels;
    try {
        levels = parseQualityLevels(test::textOf(data, size), "fuzz.toml");
    } catch (const ConfigError&) {
        return 0;
    }
    for (const SuperResMode best : {SuperResMode::Off, SuperResMode::Blend, SuperResMode::Detail})
        test::requireThat(!limitedTo(levels, best).empty(),
                          "an accepted table has no level for a mode");
    test::requireThat(parseQualityLevels(toToml(levels), "again").size() == levels.size(),
                      "a saved table has another number of levels when read again");
    return 0;
}
