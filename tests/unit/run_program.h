#pragma once

#include "tests/unit/temp_folder.h"

#include <fmt/format.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace mfar::test {

struct Outcome {
    int status = -1;  ///< exit status; if a signal n ended the program, -1 or the shell's 128 + n
    std::string text;
};

inline Outcome execute(const TempFolder& folder, const std::string& command) {
    const std::filesystem::path log = folder / "log.txt";
    const int raw = std::system(fmt::format("{} >'{}' 2>&1", command, log.string()).c_str());
    return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, readFile(log)};
}

}  // namespace mfar::test
