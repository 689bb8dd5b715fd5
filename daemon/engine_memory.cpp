#include "daemon/engine_memory.h"

#include "base/whole_file.h"
#include "daemon/engine_config.h"

#include <nlohmann/json.hpp>

#include <system_error>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

// Size limit of the file. The choices for hundreds of drivers fit into it, so a larger file was not
// written by mfard.
constexpr std::uintmax_t kMostBytes = 65536;

nlohmann::json kept(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    if (error || bytes > kMostBytes) return nlohmann::json::object();
    std::ifstream in(file);
    nlohmann::json all = nlohmann::json::parse(in, nullptr, false);
    return all.is_object() ? all : nlohmann::json::object();
}

}  // namespace

std::filesystem::path engineMemoryFile() {
    const char* folder = std::getenv("STATE_DIRECTORY");
    return folder != nullptr && *folder != '\0' ? std::filesystem::path(folder) / "engines.json"
                                                : std::filesystem::path();
}

std::optional<EngineChoice> rememberedEngines(const std::filesystem::path& file,
                                              const std::string& key) {
    if (file.empty()) return std::nullopt;
    const nlohmann::json all = kept(file);
    const auto found = all.find(key);
    if (found == all.end() || !found->is_string()) return std::nullopt;
    return parseEngineChoice(found->get<std::string>());
}

bool rememberEngines(const std::filesystem::path& file, const std::string& key,
                     const EngineChoice& choice) {
    if (file.empty()) return false;
    nlohmann::json all = kept(file);
    all[key] = describe(choice);
    const std::string text = all.dump(2) + '\n';
    try {
        writeWholeFile(file, text);
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

}  // namespace mfar
