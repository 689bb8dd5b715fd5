#include "base/calibration/calibration_error.h"
#include "base/calibration/plausible.h"
#include "base/calibration/rig_files.h"
#include "daemon/after_output.h"
#include "daemon/exit_code.h"
#include "daemon/tools/calibrate/arguments.h"
#include "daemon/tools/calibrate/collect.h"
#include "daemon/tools/calibrate/output_folder.h"
#include "daemon/tools/calibrate/report.h"
#include "daemon/tools/calibrate/residual_picture.h"

#include <fmt/format.h>

#include <system_error>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace mfar::calibration {
namespace {

Target targetOf(const CalibrateArguments& a) {
    if (!a.aprilGridFile.empty()) return readAprilGrid(a.aprilGridFile);
    if (!a.board.empty()) return checkerboard(a.board, a.square);
    throw std::runtime_error(
        "a target is needed: --aprilgrid FILE or --checkerboard 9x6 --square 0.025");
}

/// Searches for the target in all pictures. On a terminal, redraws the map of the found corners
/// after every fifth picture. Without a terminal, prints the map once, at the end.
SensorViews look(const std::vector<RecordedImage>& pictures, Size size, const Target& target,
                 const char* name) {
    const bool terminal = isatty(STDOUT_FILENO) == 1;
    std::string shown;
    SensorViews out = collect(pictures, size, target, [&](const Progress& now) {
        const bool last = now.done == now.of;
        if (!last && (!terminal || now.done % 5 != 0)) return;
        const std::string title =
            fmt::format("{}: {} of {} pictures searched, {} show the target, {:.0f} % covered   ",
                        name, now.done, now.of, now.found, 100 * now.coverage.share());
        if (terminal && !shown.empty()) fmt::print("\x1b[{}A", Coverage::kRows + 3);
        shown = mapText(now.coverage, title);
        fmt::print("{}", shown);
        std::fflush(stdout);
    });
    return out;
}

void requirePlausibleOffset(double seconds) {
    if (const auto fault = plausible::timeOffsetFault(seconds, "the time offset"))
        throw std::runtime_error(*fault + ". It includes the time_offset of the recording");
}

/// Throws if mfard would refuse this calibration. So a calibration in use is only replaced by one
/// that can be used.
void requireUsable(const RigCalibration& calibration) {
    std::string folder =
        (std::filesystem::temp_directory_path() / "mfar-calibrate.XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr)
        throw std::system_error(errno, std::generic_category(), folder);
    const std::shared_ptr<void> atEnd(nullptr, [&](void*) {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    });
    saveRig(folder, calibration);
    try {
        (void)loadRig(folder);
    } catch (const CalibrationError& error) {
        std::string fault = error.what();
        if (fault.starts_with(folder + "/")) fault.erase(0, folder.size() + 1);
        throw std::runtime_error(fmt::format(
            "the result cannot be used and was not written: {}; record the target also at the "
            "borders and in the corners of the pictures, or try --k3",
            fault));
    }
}

void run(const CalibrateArguments& a) {
    const Target target = targetOf(a);
    const OutputFolder out(a.out);
    const Recording recording = loadRecording(a.recording);
    const SensorViews video = look(recording.video, recording.rig.video.size, target, "video");
    const SensorViews still = look(recording.stills, recording.rig.still.size, target, "still");
    Calibration calibration = calibrate(target, video, still, a.solve);
    calibration.rig.stillTimeOffset += recording.stillTimeOffset;
    requirePlausibleOffset(calibration.rig.stillTimeOffset);
    fmt::print("{}{}", viewsText(calibration), resultText(calibration));
    requireUsable(calibration.rig);
    saveRig(a.out, calibration.rig);
    saveResidualPicture(a.out / "residuals.png", calibration);
    fmt::print("written: rig.yaml video.yaml still.yaml residuals.png in {}\n", a.out.string());
}

}  // namespace
}  // namespace mfar::calibration

int main(int argc, char** argv) {
    mfar::calibration::CalibrateParser parser;
    try {
        parser.app.parse(argc, argv);
        mfar::calibration::run(parser.arguments);
        return mfar::afterOutput(0, "mfar-calibrate", 1);
    } catch (const CLI::ParseError& error) {
        if (parser.app.exit(error) != 0) return static_cast<int>(mfar::ExitCode::Usage);
        return mfar::afterOutput(0, "mfar-calibrate", 1);
    } catch (const std::exception& e) {
        fmt::print(stderr, "mfar-calibrate: {}\n", e.what());
        return 1;
    }
}
