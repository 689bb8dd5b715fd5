#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <unistd.h>

#include <filesystem>
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

}  // namespace mfar
