#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>

namespace mfar {

/// Validator of an option that names a file to write. A file that cannot be written is refused
/// before the work, not after it. The validator creates no file.
[[nodiscard]] inline CLI::Validator fileToWrite() {
    return CLI::Validator(
        [](const std::string& name) -> std::string {
            const std::filesystem::path file(name), parent = file.parent_path();
            std::error_code ignored;
            if (std::filesystem::is_directory(file, ignored)) return name + " is a folder";
            const bool exists = std::filesystem::exists(file, ignored);
            const std::filesystem::path place = exists ? file : parent.empty() ? "." : parent;
            if (!exists && !std::filesystem::is_directory(place, ignored))
                return fmt::format("{} cannot be written: its folder does not exist", name);
            return access(place.c_str(), W_OK) == 0 ? "" : name + " cannot be written";
        },
        "");
}

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
