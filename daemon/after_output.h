#pragma once

#include <cstdio>
#include <iostream>
#include <string>

namespace mfar {

/// Returns the exit status of a program that ends with `status`. If standard output could not be
/// written, prints a message and returns `failed` instead of 0.
[[nodiscard]] inline int afterOutput(int status, const char* program, int failed) {
    std::cout.flush();
    const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
    if (written) return status;
    std::fputs((std::string(program) + ": standard output cannot be written\n").c_str(), stderr);
    return status == 0 ? failed : status;
}

}  // namespace mfar
