#!/bin/bash
# A virtual object stands in the world of the tags, is hidden by what is nearer, and can be changed
# while mfard runs.
. "$(dirname "$0")/lib.sh"

"$sim" --scene office --path handheld --seconds 0.3 --stills 3 --no-truth \
    --out run >/dev/null || fail "no recording"

run 0 --recording run --display png:plain
# In front of everything on the desk, and far behind the wall.
cat >near.toml <<'END'
[[objects]]
shape = "box"
size = [0.1, 0.1, 0.1]
position = [0.0, 0.0, 0.06]
END
sed 's/^position.*/position = [0.0, 3.0, -0.6]/; s/^size.*/size = [0.6, 0.6, 0.6]/' near.toml >far.toml
run 0 --recording run --display png:near --config near.toml --summary summary.json
says summary.json '"depth_tiles": [1-9]'
run 0 --recording run --display png:far --config far.toml
last=$(ls plain | sort -n | tail -n 1)
cmp -s "plain/$last" "near/$last" && fail "the object is not shown"
cmp "plain/$last" "far/$last" || fail "the wall does not hide what is behind it"

echo "with nothing in it the configuration costs nothing"
: >none.toml
run 0 --recording run --display png:none --config none.toml --summary summary.json
summary_has depth_tiles 0
cmp "plain/$last" "none/$last" || fail "the picture differs without objects"

echo "objects are read again on SIGHUP"
cp none.toml live.toml
start --source synthetic:office,rest --config live.toml --display png:live --summary summary.json
until_true started
cp near.toml live.toml
kill -HUP "$pid"
until_true grep -q 'read again' err
sleep 2
kill -TERM "$pid"
ends_with 0 1500
says summary.json '"depth_tiles": [1-9]'

echo "a wrong object is refused with its place"
echo 'size = [0, 1, 1]' >>near.toml
sed -i '/^size = \[0.1/d' near.toml
run 78 --recording run --config near.toml
says err 'near.toml:[0-9]+:[0-9]+: objects\[0\].size must hold numbers'
