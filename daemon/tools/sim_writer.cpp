#include "daemon/tools/sim_writer.h"

#include "pipeline/track/tag_map.h"

#include <fmt/format.h>

namespace mfar {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using View = SyntheticBoard::View;

TagMap mapOf(const std::vector<synthetic::Tag>& tags) {
    std::vector<MappedTag> out;
    for (const synthetic::Tag& tag : tags)
        out.push_back({{TagFamily::Tag36h11, tag.id}, tag.size, tag.T_world_tag});
    return TagMap(out);
}

class Writer {
public:
    Writer(SyntheticBoard& board, const SimOptions& options)
        : board_(board), options_(options), truth_(options.out / "truth"),
          recorder_(options.out, board.rig(), board.video().info().rateHz, {.patience = 1min}) {
        if (options.highRes) fs::create_directories(truth_ / "highres");
        if (options.depth) fs::create_directories(truth_ / "inverse_depth");
        if (options.flow) fs::create_directories(truth_ / "flow");
        recorder_.addFile("tags.toml", tomlOf(mapOf(board.world().tags)));
    }

    SimCounts run(const std::function<void(int)>& progress) {
        board_.video().start();
        board_.stills().start();
        while (!board_.video().ended()) {
            const auto frame = board_.video().next(1s);
            takeStills();
            if (!frame) continue;
            takeVideo(*frame);
            progress(counts_.video);
        }
        while (!board_.stills().ended())
            if (const auto still = board_.stills().next(1s)) takeStill(*still);
        recorder_.finish();
        return counts_;
    }

private:
    void takeStills() {
        while (const auto still = board_.stills().next(0ms))
            takeStill(*still);
    }

    void takeStill(const Frame& still) {
        checked(recorder_.still(still.view(), still.time()));
        newestStill_ = still.time();
        ++counts_.stills;
    }

    void takeVideo(const Frame& frame) {
        const Timestamp t = frame.time();
        const double since = secondsBetween(board_.epoch(), t);
        if (options_.stillsHz > 0 && since * options_.stillsHz >= pulses_ - 1e-6) {
            board_.trigger().fire();
            ++pulses_;
        }
        checked(recorder_.video(frame.view(), t));
        checked(recorder_.pose(board_.pose(t)));
        if (options_.highRes)
            savePng(truth_ / "highres" / fmt::format("{}.png", t.ns), board_.highRes(t).view());
        if (options_.depth)
            savePfm(truth_ / "inverse_depth" / fmt::format("{}.pfm", t.ns), board_.inverseDepth(t));
        if (previous_) saveFlow(*previous_, View::Video, t);
        if (newestStill_) saveFlow(t, View::StillAtVideo, *newestStill_);
        previous_ = t;
        ++counts_.video;
    }

    void saveFlow(Timestamp from, View view, Timestamp to) {
        if (!options_.flow) return;
        saveFlo(truth_ / "flow" / fmt::format("{}_{}.flo", from.ns, to.ns),
                board_.flow(View::Video, from, view, to));
        ++counts_.flows;
    }

    /// Throws if `taken` is false: the recorder has refused a picture. A simulation must not lose
    /// any picture.
    void checked(bool taken) const {
        if (!taken)
            throw std::runtime_error(
                recorder_.error().value_or("a picture was lost, because the disk is too slow; "
                                           "choose another disk with --out"));
    }

    SyntheticBoard& board_;
    SimOptions options_;
    fs::path truth_;
    Recorder recorder_;
    SimCounts counts_;
    double pulses_ = 0;
    std::optional<Timestamp> previous_, newestStill_;
};

}  // namespace

SimCounts writeSimulation(SyntheticBoard& board, const SimOptions& options,
                          const std::function<void(int)>& progress) {
    return Writer(board, options).run(progress);
}

}  // namespace mfar
