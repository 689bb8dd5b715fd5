#include "daemon/tools/calibrate/arguments.h"

#include "daemon/number_range.h"
#include "daemon/tools/command_failure.h"

namespace mfar::calibration {

CalibrateParser::CalibrateParser() {
    CalibrateArguments& a = arguments;
    app.add_option("recording", a.recording,
                   "recording to read: folder in EuRoC layout with video in cam0, stills in cam1")
        ->required();
    auto* grid = app.add_option("--aprilgrid", a.aprilGridFile,
                                "target: Kalibr's description of an aprilgrid (YAML)");
    auto* board =
        app.add_option("--checkerboard", a.board,
                       "target: checkerboard with these numbers of inner corners, like 9x6");
    auto* square =
        app.add_option("--square", a.square, "edge length of a square of the checkerboard [m]");
    grid->excludes(board);
    board->needs(square);
    square->needs(board);
    app.add_option("--out", a.out,
                   "folder to write: rig.yaml, video.yaml, still.yaml, residuals.png")
        ->required();
    app.add_option("--max-offset", a.solve.maxOffset,
                   "largest expected difference between the clocks of the two sensors, in either "
                   "direction [s]; 0: the clocks are equal")
        ->check(numberFrom(0, 2))
        ->capture_default_str();
    app.add_flag("--k3", a.solve.k3,
                 "estimate the third radial distortion coefficient as well, for wide lenses");
    app.failure_message(commandFailure);
}

}  // namespace mfar::calibration
