#!/bin/bash
# A virtual object must be shown in front of farther real objects and be hidden by nearer ones. When
# the configuration is read again, the objects must change.
. "$(dirname "$0")/lib.sh"

ctl="$(dirname "$sim")/mfarctl"

"$sim" --scene office --path handheld --seconds 0.3 --stills 3 --no-truth \
    --out run >/dev/null || fail "mfar-sim made no recording"

# last NAME [ARGUMENT...]: plays the recording. NAME.raw gets the last shown picture.
last() {
    local name=$1
    shift
    run 0 --recording run --size 1152x864 --display "y4m:$name.y4m" --summary summary.json "$@"
    tail -c $((1152 * 864 * 3 / 2)) "$name.y4m" >"$name.raw"
}
differing() { { cmp -l plain.raw "$1.raw" || true; } | wc -l; }

last plain
cat >near.toml <<'END'
[virtual]
rendering = "preview"
[[objects]]
shape = "box"
size = [0.1, 0.1, 0.1]
position = [0.0, 0.0, 0.06]
END
sed 's/^position.*/position = [0.0, 3.0, -0.6]/; s/^size.*/size = [0.6, 0.6, 0.6]/' near.toml >far.toml
last near --config near.toml
says summary.json '"depth_tiles": [1-9]'
last far --config far.toml
near=$(differing near) far=$(differing far)
echo "$near bytes differ with the object in front, $far with the one behind"
[ "$near" -gt 12500 ] || fail "the object in front of the wall is not shown"
# Cells of unknown depth hide nothing. So specks of the object remain at the edges of real objects.
[ "$far" -lt $((near / 50)) ] || fail "the wall does not hide the object behind it"

echo "without a tag map, an object on a tag is shown once this tag is the origin of the world"
cp -r run mapless
rm mapless/tags.toml
for id in 0 1 2 3 4 5; do printf '[[objects]]\nsize = [0.1, 0.1, 0.1]\ntag = %d\n' "$id"; done >tags.toml
{ head -n 2 near.toml; cat tags.toml; } >standing.toml
run 0 --recording mapless --config standing.toml --size 1152x864 --display y4m:standing.y4m
tail -c $((1152 * 864 * 3 / 2)) standing.y4m >standing.raw
[ "$(differing standing)" -gt 5000 ] || fail "the object on the tag is not shown"
[ "$(grep -c 'is not shown: it stands on tag' err)" = 5 ] ||
    fail "mfard did not report the 5 objects on other tags"

echo "a configuration without objects does not change the picture"
head -n 2 near.toml >none.toml
last none --config none.toml
summary_has depth_tiles 0
cmp plain.raw none.raw ||
    fail "a configuration without objects changes the picture"

echo "SIGHUP reads the objects again"
cp none.toml live.toml
start --source synthetic:office,rest --config live.toml --size 1152x864 --display png:live \
    --control control --summary summary.json
until_true started
cp near.toml live.toml
kill -HUP "$pid"
until_true grep -q 'read again' err
measures_depth() { "$ctl" --socket control stats | grep -Eq '"depth_tiles": [1-9]'; }
until_true measures_depth
kill -TERM "$pid"
ends_with 0 1500
says summary.json '"depth_tiles": [1-9]'

echo "SIGHUP adds and removes path-traced objects"
: >traced.toml
start --source synthetic:office --config traced.toml --size 1152x864 --display none --control control
until_true started
sed '/^\[virtual\]/d; /^rendering/d' near.toml >traced.toml
kill -HUP "$pid"
counted() { "$ctl" --socket control stats | sed -n "s/.*\"$1\": *\([0-9]*\).*/\1/p" | head -n 1; }
# True if the objects' picture is warped in further frames. The camera moves.
warps() {
    local frames warped
    frames=$(counted frames) warped=$(counted frames_warped)
    passed() { [ "$(counted frames)" -gt $((frames + 10)) ]; }
    until_true passed
    [ "$(counted frames_warped)" != "$warped" ]
}
until_true warps
: >traced.toml
kill -HUP "$pid"
rests() { ! warps; }
until_true rests
kill -TERM "$pid"
ends_with 0 1500

echo "an invalid object is refused with its line and column"
echo 'size = [0, 1, 1]' >>near.toml
sed -i '/^size = \[0.1/d' near.toml
run 78 --recording run --config near.toml
says err 'near.toml:[0-9]+:[0-9]+: objects\[0\].size must hold numbers'
