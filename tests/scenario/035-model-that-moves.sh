#!/bin/bash
# mfard must play the first animation of a model's file: it must draw the model anew in every frame,
# even while the camera rests. An animation that it cannot play must cause one message, even if mfard
# only checks the configuration.
. "$(dirname "$0")/lib.sh"

ctl="$(dirname "$sim")/mfarctl"
# True after the model was drawn 60 times. A model at rest is drawn only about 20 times, while its
# picture gets more samples.
is_drawn_anew() {
    timeout $((10 * patience)) "$ctl" --socket control stats | grep -Eq '"frames_warped": *([6-9][0-9]|[0-9]{3,})'
}

# model NAME CHANNEL...: writes NAME.gltf, a triangle whose animation has these channels, and
# mfard.toml, which places this model. Sampler 0 of the animation rises by 10 cm in 2 s.
model() {
    local name=$1 channels IFS=,
    shift
    channels="$*"
    cat >"$name.gltf" <<END
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "materials": [{"doubleSided": true}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
               {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR"},
               {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                 {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
 "buffers": [{"byteLength": 68, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAzcxMPgAAAAAAAAAAAAAAAM3MTD4AAAAAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAAAAzczMPQAAAAA="}],
 "animations": [{"samplers": [{"input": 1, "output": 2}], "channels": [$channels]}]}
END
    printf '[[objects]]\nmodel = "%s.gltf"\nposition = [0.02, 0.42, 0.0]\n' "$name" >mfard.toml
}
rises='{"sampler": 0, "target": {"node": 0, "path": "translation"}}'
grows='{"sampler": 0, "target": {"node": 0, "path": "scale"}}'

model growing "$rises" "$grows"
said='warning: .*growing.gltf: animations\[0\].channels\[1\]: changes of the scale are not played$'
run 0 --config mfard.toml --check-config
says out '^ok$'
says err "$said"
[ "$(wc -l <err)" = 1 ] || fail "mfard did not write exactly one message"
run 0 --source synthetic:office,rest --display none --frames 20 --config mfard.toml
[ "$(grep -c "changes of the scale" err)" = 1 ] || fail "mfard did not warn exactly once"

model moving "$rises"
run 0 --config mfard.toml --check-config
[ ! -s err ] || fail "mfard warns about an animation that it plays"
start --source synthetic:office,rest --display none --control control --config mfard.toml
until_true is_drawn_anew
kill -TERM "$pid"
wait "$pid" || fail "mfard ended with an exit code other than 0"
