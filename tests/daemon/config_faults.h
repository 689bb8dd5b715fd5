#pragma once

#include "daemon/config.h"

#include <string>
#include <string_view>

namespace mfar::test {

[[nodiscard]] inline std::string configFaults(std::string_view toml) {
    try {
        (void)parseConfig(toml, "test.toml");
        return "";
    } catch (const ConfigError& error) {
        return error.what();
    }
}

}  // namespace mfar::test
