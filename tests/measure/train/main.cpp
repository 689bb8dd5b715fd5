#include "base/whole_file.h"
#include "daemon/output_checks.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/recording.h"
#include "tests/measure/train/enlarger_training.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <exception>

namespace {

using namespace mfar;
using namespace mfar::train;

constexpr const char* kHelp =
    "Learns the filters that mfar ships (pipeline/enlarge/prior.filters) from the sharp\n"
    "pictures of recordings (truth/highres, as mfar-sim writes them). From each sharp picture,\n"
    "four video pictures are made, whose pixels are means over their areas. The first has no\n"
    "noise, the second noise of sigma 0.7 (grey levels), the third noise of sigma 1.5, and the\n"
    "fourth noise of sigma 0.7 and a slight blur. Every fourth sharp picture only serves to\n"
    "check the filters: a class whose filter is not better than bicubic enlargement in these\n"
    "pictures gets no filter. The same recordings give the same file.\n";

constexpr double kRidge = 20;
constexpr int kHeldOutOf = 4;
constexpr Sensor kSensors[] = {{0, 0, 1}, {0.7, 0, 2}, {1.5, 0, 3}, {0.7, 0.04, 4}};

struct Options {
    std::vector<std::filesystem::path> recordings;
    std::filesystem::path out;
};

twin::Grey lumaOf(const StoredImage& image) {
    return twin::greyOf(image.size, [&](int x, int y) {
        const std::uint8_t* p =
            &image.pixels[4 * (static_cast<std::size_t>(y) * image.size.width + x)];
        return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
    });
}

/// Adds all sharp pictures of the recordings and returns their number.
int addPictures(const std::vector<std::filesystem::path>& recordings, EnlargerTraining& training) {
    int pictures = 0;
    for (const std::filesystem::path& root : recordings) {
        const Recording recording = loadRecording(root);
        const int before = pictures;
        for (const RecordedImage& frame : recording.video) {
            const auto file = recording.truthHighRes(frame.time);
            if (!file) continue;
            const twin::Grey sharp = lumaOf(loadImage(*file));
            const bool heldOut = ++pictures % kHeldOutOf == 0;
            for (Sensor sensor : kSensors) {
                sensor.seed += 16U * static_cast<unsigned>(pictures);
                training.add({sharp, sensor}, heldOut);
            }
        }
        if (pictures == before)
            throw std::runtime_error(root.string() +
                                     ": truth/highres has no picture of a video frame");
    }
    if (pictures < kHeldOutOf)
        throw std::runtime_error(
            fmt::format("at least {} sharp pictures are needed, because every fourth only serves "
                        "to check the filters; the number of pictures is {}",
                        kHeldOutOf, pictures));
    return pictures;
}

void learn(const Options& options) {
    EnlargerTraining training;
    const int pictures = addPictures(options.recordings, training);
    const EnlargerTraining::Outcome outcome = training.solve(kRidge);
    const auto gain = [&](int by) {
        return 10 * std::log10(outcome.cubicError[by] / outcome.error[by]);
    };
    fmt::print(
        "read {} pictures. {} of {} classes have a filter. On the pictures that were kept for the "
        "check, the filters are better than bicubic by {:.2f} dB (classes by gradient) and "
        "{:.2f} dB (classes by curvature)\n",
        pictures, outcome.used, enlarge::kUnique, gain(0), gain(1));
    const FilterBank checked(outcome.filters);
    writeWholeFile(options.out, storedFilters(outcome.filters));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("mfar-train-enlarger: learns the filters that mfar ships");
    app.footer(kHelp);
    Options options;
    app.add_option("recording", options.recordings, "folders of recordings, in the EuRoC layout")
        ->required();
    app.add_option("--out", options.out, "file to write the filters into")
        ->required()
        ->check(fileToWrite());
    CLI11_PARSE(app, argc, argv);
    try {
        learn(options);
        return 0;
    } catch (const std::exception& e) {
        fmt::print(stderr, "mfar-train-enlarger: {}\n", e.what());
        return 1;
    }
}
