#include "hal/virtual/synthetic_store.h"

#include "base/bounded_file.h"
#include "base/whole_file.h"
#include "hal/virtual/synthetic_hash.h"

#include <fmt/format.h>

#include <system_error>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mfar::synthetic {
namespace {

namespace fs = std::filesystem;

class Key {
public:
    explicit Key(std::uint64_t kind) : hash_(mix(MFAR_SYNTHETIC_CODE ^ kind)) {
        for (const char c : cv::getVersionString())
            add(c);
    }

    void add(double v) { hash_ = mix(hash_ ^ std::bit_cast<std::uint64_t>(v)); }
    template <class Derived>
    void add(const Eigen::DenseBase<Derived>& values) {
        for (const double v : values)
            add(v);
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_;
};

/// Computes four independent sums, because the CPU then executes their multiplications in parallel.
std::uint64_t checksum(std::span<const std::uint8_t> bytes, std::uint64_t key) {
    std::array<std::uint64_t, 4> sums{key, key + 1, key + 2, key + 3};
    std::array<std::uint64_t, 4> words{};
    for (std::size_t i = 0; i + sizeof(words) <= bytes.size(); i += sizeof(words)) {
        std::memcpy(words.data(), &bytes[i], sizeof(words));
        for (std::size_t k = 0; k < words.size(); ++k)
            sums[k] = (std::rotl(sums[k], 23) ^ words[k]) * 0x9e3779b97f4a7c15ULL;
    }
    return mix(mix(sums[0] ^ mix(sums[1])) ^ mix(sums[2] ^ mix(sums[3])));
}

/// Reads a file of texels and their checksum. Returns nothing if the file is missing or broken.
std::optional<cv::Mat4b> stored(const fs::path& file, std::uint64_t key, int side) {
    cv::Mat4b texels(side, side);
    const std::size_t size = texels.total() * texels.elemSize();
    std::uint64_t sum = 0;
    try {
        const std::vector<std::uint8_t> bytes = boundedFile(file, size + sizeof(sum));
        if (bytes.size() != size + sizeof(sum)) return std::nullopt;
        std::memcpy(texels.data, bytes.data(), size);
        std::memcpy(&sum, &bytes[size], sizeof(sum));
        if (sum != checksum({texels.data, size}, key)) return std::nullopt;
    } catch (const std::exception&) {  // The file is missing or cannot be read.
        return std::nullopt;
    }
    return texels;
}

/// Removes the least recently used files, until `most` remain.
void removeOldest(const fs::path& folder, std::size_t most) {
    std::error_code ignored;
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        files.emplace_back(entry.last_write_time(ignored), entry.path());
    if (files.size() <= most) return;
    std::ranges::sort(files);
    files.resize(files.size() - most);
    for (const auto& [time, file] : files)
        fs::remove(file, ignored);
}

void store(const fs::path& file, std::uint64_t key, const cv::Mat4b& texels) {
    const std::size_t size = texels.total() * texels.elemSize();
    const std::uint64_t sum = checksum({texels.data, size}, key);
    std::vector<std::uint8_t> bytes(size + sizeof(sum));
    std::memcpy(bytes.data(), texels.data, size);
    std::memcpy(&bytes[size], &sum, sizeof(sum));
    try {
        fs::create_directories(file.parent_path());
        removeOldest(file.parent_path(), TexelStore::kMostFiles - 1);
        // A file that a power cut truncates is detected by its size or checksum.
        writeWholeFile(file, bytes, Durability::WithSync);
    } catch (const std::exception&) {  // Errors are ignored, because the store only saves time.
    }
}

}  // namespace

TexelStore::TexelStore(fs::path folder) : folder_(std::move(folder)) {}

cv::Mat4b TexelStore::get(std::uint64_t key, int side,
                          const std::function<cv::Mat4b()>& make) const {
    if (folder_.empty()) return make();
    const fs::path file = folder_ / fmt::format("{:016x}", key);
    if (std::optional<cv::Mat4b> texels = stored(file, key, side)) {
        std::error_code ignored;
        fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
        return *texels;
    }
    const cv::Mat4b texels = make();
    store(file, key, texels);
    return texels;
}

fs::path TexelStore::userFolder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value == nullptr ? "" : value);
    };
    const fs::path own = variable("MFAR_CACHE"), cache = variable("XDG_CACHE_HOME"),
                   home = variable("HOME");
    if (!own.empty()) return own / "synthetic";
    if (!cache.empty()) return cache / "mfar/synthetic";
    return home.empty() ? home : home / ".cache/mfar/synthetic";
}

std::uint64_t lightKey(const World& world) {
    Key key(1);
    for (const Primitive& p : world.primitives) {
        key.add(static_cast<double>(p.shape));
        key.add(p.T_world_prim.rotation.coeffs());
        key.add(p.T_world_prim.translation);
        key.add(p.half);
        key.add(p.lightTexels);
        key.add(p.moves ? 1 : 0);
        for (const int material : p.materials)
            key.add(world.materials[material].tint);
    }
    const Lighting& light = world.light;
    for (const Eigen::Vector3d& v :
         {light.towards, light.key, light.ambient, world.eye, world.target})
        key.add(v);
    key.add(light.spread);
    return key.value();
}

std::uint64_t layerKey(Layer layer, std::uint64_t seed) {
    Key key(2);
    key.add(static_cast<double>(layer));
    key.add(std::bit_cast<double>(seed));
    return key.value();
}

}  // namespace mfar::synthetic
