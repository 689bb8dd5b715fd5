// Runs a fuzz target once for each file in some folders: seeds, and inputs that failed before.
// Replaces libFuzzer's main().
#include "tests/fuzz/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> filesIn(const fs::path& given) {
    if (!fs::is_directory(given)) return {given};
    std::vector<fs::path> out;
    for (const auto& entry : fs::directory_iterator(given))
        if (entry.is_regular_file()) out.push_back(entry.path());
    std::ranges::sort(out);
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    int count = 0;
    for (int i = 1; i < argc; ++i)
        for (const fs::path& file : filesIn(argv[i])) {
            std::ifstream in(file, std::ios::binary);
            const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
            fmt::print("{}\n", file.string());
            std::fflush(stdout);  // the target may end the process
            LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                   bytes.size());
            ++count;
        }
    fmt::print("{} inputs\n", count);
    return count > 0 ? 0 : 1;
}
