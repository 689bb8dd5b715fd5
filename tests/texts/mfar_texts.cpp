// Writes the texts that are printed from tables into a source tree, or into another folder to
// compare them. Usage: mfar-texts FOLDER
#include "daemon/option_text.h"
#include "tests/texts/pages.h"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

constexpr std::string_view kValues = R"("\"\"\""
"'''"
"true"
"false"
"nan"
"inf"
"9007199254740993"
"1979-05-27"
)";
constexpr std::string_view kLevelValues = R"("\"detail\""
"\"blend\""
"\"off\""
"\"\"\""
)";

void write(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream out(file);
    out << text;
    if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: mfar-texts FOLDER\n");
        return 64;
    }
    try {
        const std::filesystem::path folder = argv[1];
        write(folder / "systemd/mfard.toml", mfar::defaultConfigText());
        write(folder / "systemd/mfard.bash-completion", mfar::test::bashCompletion());
        write(folder / "systemd/mfarctl.bash-completion", mfar::test::controlCompletion());
        write(folder / "docs/configuration.md", mfar::test::configurationPage());
        write(folder / "tests/fuzz/config.dict",
              mfar::test::fuzzDictionary(mfar::configOptions(), kValues));
        write(folder / "tests/fuzz/quality.dict",
              mfar::test::fuzzDictionary(mfar::levelOptions(), kLevelValues));
        write(folder / "docs/man/mfard.1", mfar::test::programManPage());
        write(folder / "docs/man/mfarctl.1", mfar::test::controlManPage());
        write(folder / "docs/man/mfar-sim.1", mfar::test::simManPage());
        write(folder / "docs/man/mfar-calibrate.1", mfar::test::calibrateManPage());
        write(folder / "docs/man/mfar-print.1", mfar::test::printManPage());
        write(folder / "docs/man/mfard.toml.5", mfar::test::configManPage());
    } catch (const std::exception& error) {
        fmt::print(stderr, "mfar-texts: {}\n", error.what());
        return 1;
    }
    return 0;
}
