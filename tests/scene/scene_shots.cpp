#include "tests/scene/scene_shots.h"

#include "pipeline/results.h"

#include <cmath>
#include <stdexcept>

namespace mfar::test {
namespace {

using namespace std::chrono_literals;
using View = SyntheticBoard::View;

Frame taken(Camera& camera) {
    auto frame = camera.next(60s);
    if (!frame) throw std::runtime_error("the board gave no picture");
    return std::move(*frame);
}

std::unique_ptr<SyntheticBoard> boardOf(synthetic::Scene scene, synthetic::Path path) {
    SyntheticOptions options;
    options.scene = scene;
    options.path = path;
    options.pace = Pace::Consumer;
    auto board = std::make_unique<SyntheticBoard>(options);
    board->video().start();
    board->stills().start();
    return board;
}

Frame firstStill(SyntheticBoard& board) {
    static_cast<void>(taken(board.video()));
    board.trigger().fire();
    for (int i = 0; i < 10; ++i) {
        static_cast<void>(taken(board.video()));
        if (auto still = board.stills().next(0s)) return std::move(*still);
    }
    throw std::runtime_error("the board gave no still");
}

Frame frameAfter(SyntheticBoard& board, int frames) {
    for (int i = 1; i < frames; ++i)
        static_cast<void>(taken(board.video()));
    return taken(board.video());
}

}  // namespace

SceneShots::SceneShots(synthetic::Scene scene, synthetic::Path path, int framesLater)
    : board(boardOf(scene, path)), still(firstStill(*board)),
      frame(frameAfter(*board, framesLater)) {}

std::vector<bool> SceneShots::movingTiles() const {
    const CameraModel& camera = board->rig().video;
    const Size size = camera.size;
    const FloatImage inverseDepth = board->inverseDepth(frame.time());
    const FlowImage flow = board->flow(View::Video, frame.time(), View::StillAtVideo, still.time());
    // `unturn` gives the still's camera the orientation of the video camera. So the rig's rotation
    // does not count as motion.
    RigidTransform T_still_video = board->rig().T_still_video;
    const Eigen::Matrix3d unturn = T_still_video.rotation.toRotationMatrix().transpose();
    const RigidTransform T_then_now =
        board->pose(still.time()).T_world_video.inverse() * board->pose(frame.time()).T_world_video;
    const auto [columns, rows] = tilesOf(size);
    std::vector<int> moved(static_cast<std::size_t>(columns) * rows);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * size.width + x;
            if (!(inverseDepth.values[i] > 0) || !std::isfinite(flow.vectors[i][0])) continue;
            const Eigen::Vector2d ray = camera.unproject({1. * x, 1. * y});
            const Eigen::Vector3d now =
                Eigen::Vector3d(ray.x(), ray.y(), 1) / inverseDepth.values[i];
            const Eigen::Vector3d then = unturn * (T_still_video * (T_then_now * now));
            const Eigen::Vector2d rigid = camera.project(then.head<2>() / then.z());
            const double off =
                std::hypot(x + flow.vectors[i][0] - rigid.x(), y + flow.vectors[i][1] - rigid.y());
            if (off > 1) ++moved[static_cast<std::size_t>(y / kTileSize) * columns + x / kTileSize];
        }
    std::vector<bool> out;
    for (const int pixels : moved)
        out.push_back(4 * pixels >= kTileSize * kTileSize);
    return out;
}

}  // namespace mfar::test
