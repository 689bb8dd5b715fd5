#!/usr/bin/env bash
# Runs the daemon on the simulated board and saves pictures of the results. Usage: demo.sh
# BUILD_FOLDER OUTPUT_FOLDER
set -euo pipefail
build=$1
out=$2
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
frames=45
seconds=1

# The results of an earlier run are replaced only by complete new ones. A run that was killed leaves
# this folder behind.
work=$out.new
rm -rf "$work"
trap 'rm -rf "$work"' EXIT
new=$work/results
mkdir -p "$new"

echo "1/3  mfard on the synthetic scene 'office', hand-held, $frames frames"
"$build/daemon/mfard" --source synthetic:office --pace consumer --frames "$frames" \
    --config "$here/demo.toml" --display "y4m:$work/video.y4m" --summary "$new/summary.json"

echo "2/3  the same scene with its truth, for comparison"
"$build/daemon/tools/mfar-sim" --scene office --path handheld --seconds "$seconds" --stills 4 \
    --out "$work/recording"

echo "3/3  pictures"
"$build/tests/demo/mfar-demo" "$work/recording" "$new" --video "$work/video.y4m" \
    --scene office --objects "$here/demo.toml" --virtual "$here/virtual.toml"

rm -rf "$out"
mv "$new" "$out"

cat <<EOF

In $out:
  comparison.png    enlarged video, result and truth, with a magnified part
  occlusion.png     a virtual ball behind real things: drawn over everything, mfar's result, truth
  virtual.png       a path traced jar on the desk, while the camera moves and at rest
  depth.png         depth of the desk, truth and error
  confidence.png    confidence of the match of each video pixel
  tile_classes.png  the work that each tile needed
  video.avi         what the daemon showed, at half size
  summary.json      the daemon's times and counters
EOF
