#include "hal/virtual/image_files.h"
#include "hal/virtual/recording.h"
#include "tests/fuzz/file_bundle.h"
#include "tests/fuzz/target.h"

namespace {

using namespace mfar;

constexpr std::size_t kMostPixels = 1 << 16;

template <class Read>
void tryTo(const Read& read) {
    try {
        read();
    } catch (const ImageFileError&) {
        return;
    }
}

void readPicture(const RecordedImage& image, Size size) {
    const std::size_t pixels = static_cast<std::size_t>(size.width) * size.height;
    if (pixels > kMostPixels) return;
    std::vector<std::uint8_t> rgba(4 * pixels);
    tryTo([&] { loadImageInto(image.file, size, rgba.data(), std::size_t{4} * size.width); });
}

void read(const Recording& recording) {
    test::requireThat(!recording.video.empty() && recording.videoRateHz > 0,
                      "an accepted recording has no video frames or no frame rate");
    const Timestamp first = recording.video.front().time;
    readPicture(recording.video.front(), recording.rig.video.size);
    if (!recording.stills.empty()) readPicture(recording.stills.front(), recording.rig.still.size);
    if (const auto pose = recording.poseAt(first))
        test::requireThat(pose->T_world_video.translation.allFinite(),
                          "an accepted recorded pose is not finite");
    if (const auto file = recording.truthInverseDepth(first))
        tryTo([&] { static_cast<void>(loadPfm(*file)); });
    if (const auto file = recording.truthFlow(first, first))
        tryTo([&] { static_cast<void>(loadFlo(*file)); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::string> kNames{
        "cam0/sensor.yaml",          "cam0/data.csv",
        "cam0/data/1.png",           "cam0/data/2.png",
        "cam1/sensor.yaml",          "cam1/data.csv",
        "cam1/data/1.png",           "state_groundtruth_estimate0/data.csv",
        "truth/inverse_depth/1.pfm", "truth/flow/1_1.flo"};
    const test::FileBundle bundle(data, size, kNames);
    try {
        read(loadRecording(bundle.folder()));
    } catch (const RecordingError&) {
        return 0;
    }
    return 0;
}
