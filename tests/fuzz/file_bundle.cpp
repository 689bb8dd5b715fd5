#include "tests/fuzz/file_bundle.h"

#include "tests/fuzz/target.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string_view>

namespace mfar::test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "#@ ";

fs::path newFolder() {
    std::error_code error;
    const fs::path top =
        fs::is_directory("/dev/shm", error) ? fs::path("/dev/shm") : fs::temp_directory_path();
    std::string name = (top / "mfar-fuzz-XXXXXX").string();
    requireThat(mkdtemp(name.data()) != nullptr, "a folder for the input files cannot be created");
    return name;
}

std::size_t nextMark(std::string_view text, std::size_t from) {
    for (std::size_t at = text.find(kMark, from); at != text.npos; at = text.find(kMark, at + 1))
        if (at == 0 || text[at - 1] == '\n') return at;
    return text.size();
}

}  // namespace

FileBundle::FileBundle(const std::uint8_t* data, std::size_t size,
                       const std::vector<std::string>& known)
    : folder_(newFolder()) {
    const std::string_view text = textOf(data, size);
    for (std::size_t at = nextMark(text, 0); at < text.size();) {
        const std::size_t lineEnd = std::min(text.find('\n', at), text.size());
        const std::size_t end = nextMark(text, lineEnd);
        const std::string name(text.substr(at + kMark.size(), lineEnd - at - kMark.size()));
        const std::size_t begin = std::min(lineEnd + 1, end);
        if (std::ranges::find(known, name) != known.end()) {
            const fs::path file = folder_ / name;
            fs::create_directories(file.parent_path());
            const std::size_t stop = end < text.size() ? std::max(end - 1, begin) : end;
            std::ofstream(file, std::ios::binary) << text.substr(begin, stop - begin);
            files_.push_back(file);
        }
        at = end;
    }
}

FileBundle::~FileBundle() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

}  // namespace mfar::test
