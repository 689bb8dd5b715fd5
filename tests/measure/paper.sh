#!/usr/bin/env bash
# Measures what the paper claims, and writes a page with numbers and figures: paper.md.
# Usage: paper.sh BUILD-FOLDER OUTPUT-FOLDER [--quick]. --quick only checks this script: it measures
# tiny pictures, and leaves out slow measurements.
set -euo pipefail
build=$1
out=$2
bench=$build/tests/measure/bench/mfar-bench
eval=$build/tests/measure/eval/mfar-eval
step=0 steps=6
times=() slicing=() warp=() figure7=() occlusion=() note=''
# The truth of full-size pictures would take two hours.
traced=(--width 320 --height 240 --every 30)
if [[ ${3:-} == --quick ]]; then
    note=$'\n**A quick run on tiny pictures: no number here is a measurement.**'
    times=(--quick)
    slicing=(--width 32 --height 24 --samples 4 --truth-samples 8 --frames 4)
    warp=(--width 48 --height 36 --samples 2 --truth-samples 2 --degrees 2)
    figure7=(none)
    occlusion=(none)
    traced=(none)
fi
rm -rf "$out"
mkdir -p "$out"

# measured FILE COMMAND...: runs COMMAND and writes its table to FILE. A COMMAND that ends with `none` is not run.
measured() {
    local file=$out/$1
    shift
    step=$((step + 1))
    printf '%s\n' "${*/#"$build"\//}" >"$file.command"
    printf '%s of %s: %s\n' "$step" "$steps" "$(<"$file.command")" >&2
    if [[ ${*: -1} == none ]]; then
        echo "not measured by --quick" >"$file"
    else
        "$@" >"$file"
    fi
}

# median LINE [N]: prints the median [ms] from mfar-bench's table: that of the N-th row (default: the first) named LINE.
median() {
    awk -v line="$1" -v n="${2:-1}" \
        'index($0, line " ") == 1 && --n == 0 { sub(line, ""); print $1; exit }' "$out/times.txt"
}
perSecond() { awk -v ms="$1" 'BEGIN { if (ms == "") print "not measured"; else printf "%.1f frames/s", 1000 / ms }'; }

# section TITLE NAME [FIGURE]: writes a section of the page, with the table of NAME.txt.
section() {
    printf '\n## %s\n\n' "$1"
    [[ ! -s $out/${3:-none} ]] || printf '![%s](%s)\n\n' "$1" "$3"
    printf '```\n$ %s\n' "$(cat "$out/$2.txt.command")"
    cat "$out/$2.txt"
    printf '```\n'
}

measured times.txt "$bench" "${times[@]}"
moving=$(perSecond "$(median moving)")
handheld=$(perSecond "$(median handheld)")
paper=$(perSecond "$(median 'peer paper')")
paperHandheld=$(perSecond "$(median 'peer paper' 2)")
depth=$(perSecond "$(median 'depth, whole picture')")
required=("$moving" "$handheld" "$paper" "$paperHandheld")
[[ ${3:-} == --quick ]] || required+=("$depth") # --quick has too few frames for it
for value in "${required[@]}"; do
    [[ $value != "not measured" ]] || {
        echo "a row is missing in $out/times.txt" >&2
        exit 1
    }
done
measured slicing.txt "$eval" slicing --svg "$out/slicing.svg" "${slicing[@]}"
measured warp.txt "$eval" warp --svg "$out/warp.svg" "${warp[@]}"
measured occlusion.txt "$eval" occlusion "${occlusion[@]}"
measured traced.txt "$eval" traced "${traced[@]}"
measured figure7.txt "$eval" figure7 --svg "$out/figure7.svg" "${figure7[@]}"

{
    cat <<END
# The paper's claims on this machine

The paper's machine: GTX 680. This machine: $(grep -m1 '^model name' /proc/cpuinfo | sed 's/.*: //' || uname -m), $(nproc) processors; $(sed -n 1p "$out/times.txt").
Times vary by some percent from run to run. Quality figures are the same in each run on the same engine, but for virtual objects in motion: the path tracer's depend on the machine's speed.
$note

| claim | in the paper | on this machine | the paper's method with OpenCV, on this machine |
|---|---|---|---|
| super-resolution, 640x480 to 2304x1728, camera moves, no poses | 7 frames/s | $moving | $paper |
| the same, hand-held with poses | - | $handheld | $paperHandheld |
| depth of the whole picture | 12 frames/s | $depth | - |
| quality and sharpness (Figure 7) | close to ground truth | [below](#figure-7) | below |
| slicing, warp and holes (Figure 5) | only pictures, no numbers | [below](#figure-5-slicing) | - |
| virtual objects while the camera moves | "good in any case", no numbers | [below](#virtual-objects-in-motion) | - |
END
    section "Times" times
    section "Figure 7" figure7 figure7.svg
    section "Figure 5: slicing" slicing slicing.svg
    section "Figure 5: warp and holes" warp warp.svg
    section "Occlusion" occlusion
    section "Virtual objects in motion" traced
} >"$out/paper.md"
rm "$out"/*.command
echo "$out/paper.md"
