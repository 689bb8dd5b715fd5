#include "daemon/config.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        static_cast<void>(
            mfar::parseConfig(mfar::test::textOf(data, size), "/nonexistent/mfard.toml"));
    } catch (const mfar::ConfigError&) {
        return 0;
    }
    return 0;
}
